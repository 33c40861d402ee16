/* The link's other end: a socket of this machine, for one peer at a time. While nobody is connected what is sent is
 * gone and nothing comes. Nothing here waits. */
#ifndef SOCKET_H
#define SOCKET_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/select.h>

/* Listens at "unix:PATH", connects to who listens there with "unix-connect:PATH", or does nothing if there is no text.
 * False if it cannot. */
bool socket_open(const char *where);

/* Adds what should end a wait: a peer or its bytes, room where it refused some. Returns the descriptor, or -1. */
int socket_watch(fd_set *readable, fd_set *writable);

/* Will nobody ask for anything any more? The peer has come and gone, or there is no socket. */
bool socket_is_over(void);

/* As hal_uart_write() and hal_uart_read(). */
size_t socket_write(const void *data, size_t size);
size_t socket_read(void *data, size_t size);

#endif
