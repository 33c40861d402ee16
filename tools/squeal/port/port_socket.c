/* Sockets on which a device listens, by path or by host and port. */
#include "squeal/port/port_parts.h"

#include <errno.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

int port_connect_unix(const char *path)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};

    if (strlen(path) >= sizeof address.sun_path) {
        errno = ENAMETOOLONG;
        return -1;
    }
    memcpy(address.sun_path, path, strlen(path));
    const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
    if (fd >= 0 && connect(fd, (const struct sockaddr *)&address, sizeof address) != 0) {
        const int reason = errno;
        (void)close(fd);
        errno = reason;
        return -1;
    }
    return fd;
}

bool port_open_unix(struct port *port, const char *where)
{
    port->fd = port_connect_unix(where);
    if (port->fd >= 0) {
        return true;
    }
    if (errno == ENOENT) {
        return port_fail(port, "no such socket; make console LINK=%s starts a firmware that listens there", where);
    }
    if (errno == ECONNREFUSED) {
        return port_fail(port, "nobody listens there any more; start the firmware again");
    }
    return port_fail(port, "%s", strerror(errno));
}

static int connect_tcp(const struct addrinfo *address)
{
    const int yes = 1;
    const int fd = socket(address->ai_family, address->ai_socktype, address->ai_protocol);

    if (fd >= 0 && connect(fd, address->ai_addr, address->ai_addrlen) != 0) {
        const int reason = errno;
        (void)close(fd);
        errno = reason;
        return -1;
    }
    /* A request is one small packet whose answer is waited for. */
    (void)setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    return fd;
}

bool port_open_tcp(struct port *port, const char *where)
{
    const struct addrinfo wanted = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
    char host[PORT_NAME_MAX];
    struct addrinfo *found = NULL;
    const char *colon = strrchr(where, ':');

    if (colon == NULL || colon == where || colon[1] == '\0') {
        return port_fail(port, "tcp:HOST:PORT is wanted");
    }
    const bool is_bracketed = where[0] == '[' && colon[-1] == ']';
    (void)snprintf(host, sizeof host, "%.*s", (int)(colon - where) - (is_bracketed ? 2 : 0),
                   where + (is_bracketed ? 1 : 0));
    const int failure = getaddrinfo(host, colon + 1, &wanted, &found);
    if (failure != 0) {
        return port_fail(port, "%s", gai_strerror(failure));
    }
    for (const struct addrinfo *address = found; address != NULL && port->fd < 0; address = address->ai_next) {
        port->fd = connect_tcp(address);
    }
    const int reason = errno;
    freeaddrinfo(found);
    if (port->fd < 0) {
        return port_fail(port, "%s%s", strerror(reason),
                         reason == ECONNREFUSED ? "; does the device listen there?" : "");
    }
    return true;
}
