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

/* The rest of where after kind, if it begins so and fits an address. */
static bool read_address(const char *where, const char *kind, struct sockaddr_un *address)
{
    const size_t length = strlen(kind);

    if (strncmp(where, kind, length) != 0 || strlen(where + length) >= sizeof address->sun_path) {
        return false;
    }
    *address = (struct sockaddr_un){.sun_family = AF_UNIX};
    memcpy(address->sun_path, where + length, strlen(where + length));
    return true;
}

static bool listen_at(const struct sockaddr_un *address)
{
    line.listener = socket(AF_UNIX, SOCK_STREAM, 0);
    (void)unlink(address->sun_path); /* what an earlier process left behind */
    return line.listener >= 0 && bind(line.listener, (const struct sockaddr *)address, sizeof *address) == 0 &&
           listen(line.listener, 1) == 0 && fcntl(line.listener, F_SETFL, O_NONBLOCK) == 0;
}

static bool connect_to(const struct sockaddr_un *address)
{
    line.peer = socket(AF_UNIX, SOCK_STREAM, 0);
    return line.peer >= 0 && connect(line.peer, (const struct sockaddr *)address, sizeof *address) == 0;
}

bool socket_open(const char *where)
{
    struct sockaddr_un address;

    if (where == NULL || where[0] == '\0') {
        return true;
    }
    if (read_address(where, "unix:", &address)) {
        return listen_at(&address);
    }
    return read_address(where, "unix-connect:", &address) && connect_to(&address);
}

bool socket_is_over(void) { return line.peer < 0 && (line.listener < 0 || line.is_over); }

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
