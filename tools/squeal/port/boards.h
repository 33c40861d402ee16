/* The boards that can be started here, as the Makefile tells them: a file with one line a board,
 *
 *     mps2-an386: qemu-system-arm -M mps2-an386 ... -serial unix:@LINK@,server=on,wait=off -kernel /.../squeal.elf
 *
 * beside the executable, or where SQUEAL_BOARDS says. The last word is the image; @LINK@ stands for the socket on which
 * the link is to listen. */
#ifndef SQUEAL_BOARDS_H
#define SQUEAL_BOARDS_H

#include <stdbool.h>
#include <stddef.h>

enum { BOARDS_PROBLEM_MAX = 512 };

/* The command of the board that a port's name means, host or qemu:BOARD, as words ended by NULL and with the path in
 * place; free() takes all of it back. NULL with the problem: no list of boards, no such board, or its image is not
 * built. */
char **boards_command(const char *port, const char *link, char problem[BOARDS_PROBLEM_MAX]);

/* The ports of all boards, " host qemu:mps2-an386", as far as they fit. Empty where there is no list. */
void boards_ports(char *out, size_t size);

#endif
