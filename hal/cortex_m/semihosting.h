/* Requests to the emulator or debugger that runs the program. Only for boards that always have one: without it the
 * request is a fault. */
#ifndef CORTEX_M_SEMIHOSTING_H
#define CORTEX_M_SEMIHOSTING_H

/* Ends the emulator with this exit code, 0 to 255. [ANY] */
void semihosting_exit(int code) __attribute__((noreturn));

#endif
