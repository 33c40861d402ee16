/* Checks of one part each. */
#ifndef PARTS_H
#define PARTS_H

void parts_check_canvas(void);
void parts_check_screen(void);
void parts_check_keys(void);
void parts_check_spectrum(void);
void parts_check_trace(void);
void parts_check_words(void);

#endif
