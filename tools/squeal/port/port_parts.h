/* What the kinds of port share. For the port files alone. */
#ifndef SQUEAL_PORT_PARTS_H
#define SQUEAL_PORT_PARTS_H

#include "squeal/port/port.h"

/* One for each kind: sets fd, and what else it needs, or gives false with the problem. where is what follows the kind's
 * mark in the name. */
bool port_open_tty(struct port *port, const char *where);
bool port_open_pty(struct port *port);
bool port_open_unix(struct port *port, const char *where);
bool port_open_tcp(struct port *port, const char *where);
bool port_open_board(struct port *port);

/* A socket there, connected; -1 with errno. */
int port_connect_unix(const char *path);

/* Puts "<name>: <words>" into the problem. Returns false. */
bool port_fail(struct port *port, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* What was started has ended: says how, in the problem, and reaps it. Returns false. */
bool port_lose_board(struct port *port);

#endif
