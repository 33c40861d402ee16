/* A process at the other end of a socket. Every wait has an end, and so has the process: with this one, however that
 * goes. */
#ifndef PEER_H
#define PEER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

enum { PEER_PATIENCE_S = 5 /* for whatever is waited for */ };

struct peer {
    const char *name;
    pid_t pid;
    int socket;
    bool is_busy; /* waits by looking again and again, for 2 ms, before it sleeps */
};

/* Starts argv[0] .. NULL, which must listen at path, and connects. Complains and returns false if that takes too
 * long. */
bool peer_start(struct peer *peer, char **argv, const char *path);

/* A process of our own that answers as many bytes as asked with as many as answered. */
bool peer_echo(struct peer *peer, size_t asked, size_t answered);

bool peer_send(struct peer *peer, const void *data, size_t size);

/* At least one byte; how many, or 0 with a complaint if none comes in time or the peer has ended. */
size_t peer_receive(struct peer *peer, void *data, size_t capacity);

void peer_end(struct peer *peer);

#endif
