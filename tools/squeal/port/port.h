/* A port: bytes to a device and back, however it is reached. Its name says how:
 *
 *     /dev/ttyUSB0          a serial line, 8N1 at 921600 baud, or at what follows a colon: /dev/ttyUSB0:115200
 *     unix:PATH             a socket on which a device listens
 *     tcp:HOST:PORT         the same over TCP; HOST may be [::1]
 *     pty                   a new pseudo terminal; tells its name and waits until a program opens it
 *     host                  the firmware as a process of this machine, started here
 *     qemu:BOARD            the firmware on an emulated board, started here
 *
 * What is started here ends with the port, and with this process. Nothing here listens on a network.
 *
 * Every failure leaves in problem one line for a person: the port, the cause, what to try. */
#ifndef SQUEAL_PORT_H
#define SQUEAL_PORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>

enum { PORT_NAME_MAX = 256, PORT_PROBLEM_MAX = 512 };

struct port {
    char name[PORT_NAME_MAX];
    int fd;       /* both ways, does not block; -1 closed. For poll(), beside other things to wait for */
    pid_t pid;    /* of what was started here; 0 nothing */
    FILE *errors; /* what it says on its standard error; NULL without */
    char problem[PORT_PROBLEM_MAX];
};

/* Opens the port of that name. children_guard() must have been called. False with the problem: nothing is left open,
 * but port_close() does no harm. */
bool port_open(struct port *port, const char *name);

/* Ends what was started, and reaps it. The problem stays. */
void port_close(struct port *port);

/* Moves what can be moved now: bytes read or taken, 0 if that is nothing, -1 with the problem if the other end is
 * gone. */
ssize_t port_read(struct port *port, void *bytes, size_t size);
ssize_t port_write(struct port *port, const void *bytes, size_t size);

/* Waits until there is something to read, or room to write if that is wanted; at most limit_s. False if there is
 * neither. */
bool port_wait(const struct port *port, bool wants_room, double limit_s);

/* What a port's name may be, one line each, for a help text. */
extern const char port_help[];

#endif
