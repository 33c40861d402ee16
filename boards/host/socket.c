#include "socket.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

static struct {
    int listener, peer; /* -1: none */
    bool is_refused;    /* the peer did not take all of the last write */
    bool is_over;       /* a peer has come and gone */
} line = {.listener = -1, .peer = -1};

bool socket_open(const char *where)
{
    static const char kind[] = "unix:";
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    const size_t kind_length = sizeof kind - 1u;

    if (where == NULL || where[0] == '\0') {
        return true;
    }
    if (strncmp(where, kind, kind_length) != 0 || strlen(where + kind_length) >= sizeof address.sun_path) {
        return false;
    }
    memcpy(address.sun_path, where + kind_length, strlen(where + kind_length));
    line.listener = socket(AF_UNIX, SOCK_STREAM, 0);
    (void)unlink(address.sun_path); /* what an earlier process left behind */
    return line.listener >= 0 && bind(line.listener, (const struct sockaddr *)&address, sizeof address) == 0 &&
           listen(line.listener, 1) == 0 && fcntl(line.listener, F_SETFL, O_NONBLOCK) == 0;
}

bool socket_is_over(void) { return line.listener < 0 || line.is_over; }

int socket_watch(fd_set *readable, fd_set *writable)
{
    const int watched = line.peer >= 0 ? line.peer : line.listener;

    if (watched >= 0) {
        FD_SET(watched, readable);
    }
    if (line.peer >= 0 && line.is_refused) {
        FD_SET(line.peer, writable);
    }
    return watched;
}

static void accept_peer(void)
{
    line.peer = line.listener >= 0 ? accept(line.listener, NULL, NULL) : -1;
    if (line.peer >= 0) {
        line.is_over = false;
    }
}

static void drop_peer(void)
{
    (void)close(line.peer);
    line.peer = -1;
    line.is_refused = false;
    line.is_over = true;
}

static bool is_try_again(void) { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

size_t socket_write(const void *data, size_t size)
{
    ssize_t written;

    if (line.peer < 0) {
        return size;
    }
    written = send(line.peer, data, size, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (written < 0 && !is_try_again()) {
        drop_peer();
        return size;
    }
    line.is_refused = written < (ssize_t)size;
    return written > 0 ? (size_t)written : 0u;
}

size_t socket_read(void *data, size_t size)
{
    ssize_t count;

    if (line.peer < 0) {
        accept_peer();
    }
    if (line.peer < 0) {
        return 0u;
    }
    count = recv(line.peer, data, size, MSG_DONTWAIT);
    if (count == 0 || (count < 0 && !is_try_again())) {
        drop_peer();
    }
    return count > 0 ? (size_t)count : 0u;
}
