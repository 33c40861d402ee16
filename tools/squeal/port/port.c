/* What all ports have in common: their names, and bytes through one descriptor. */
#include "squeal/port/port_parts.h"

#include "squeal/support/children.h"
#include "squeal/support/clock.h"
#include "squeal/support/printable.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdarg.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    DEATH_PATIENCE_MS = 500, /* its end of the line has closed, so its exit code is about to come */
    CLOSE_PATIENCE_MS = 50,  /* a host firmware ends when its lines do, an emulator has to be told */
    COMPLAINT_MAX = 200
};

const char port_help[] = "  /dev/ttyUSB0[:BAUD]  a serial line, 8N1, 921600 baud\n"
                         "  unix:PATH            a socket on which a device listens\n"
                         "  tcp:HOST:PORT        the same over TCP\n"
                         "  pty                  a new pseudo terminal; waits until a program opens it\n"
                         "  host                 the firmware as a process, started for this\n"
                         "  qemu:BOARD           the firmware on an emulated board, started for this\n";

bool port_fail(struct port *port, const char *format, ...)
{
    char words[PORT_PROBLEM_MAX];
    va_list arguments;
    const int length = snprintf(words, sizeof words, "%s: ", port->name);

    va_start(arguments, format);
    (void)vsnprintf(words + length, sizeof words - (size_t)length, format, arguments);
    va_end(arguments);
    (void)printable_copy(port->problem, sizeof port->problem, words);
    return false;
}

static bool open_kind(struct port *port)
{
    const char *name = port->name;

    if (name[0] == '/' || name[0] == '.') {
        return port_open_tty(port, name);
    }
    if (strncmp(name, "unix:", 5) == 0) {
        return port_open_unix(port, name + 5);
    }
    if (strncmp(name, "tcp:", 4) == 0) {
        return port_open_tcp(port, name + 4);
    }
    if (strcmp(name, "pty") == 0) {
        return port_open_pty(port);
    }
    if (strcmp(name, "host") == 0 || strncmp(name, "qemu:", 5) == 0) {
        return port_open_board(port);
    }
    return port_fail(port,
                     "no port has such a name; try host, qemu:BOARD, /dev/ttyUSB0, unix:PATH, tcp:HOST:PORT or pty");
}

bool port_open(struct port *port, const char *name)
{
    memset(port, 0, sizeof *port);
    port->fd = -1;
    (void)snprintf(port->name, sizeof port->name, "%s", name);
    if (strlen(name) >= sizeof port->name) {
        return port_fail(port, "too long a name");
    }
    if (!open_kind(port)) {
        port_close(port);
        return false;
    }
    (void)fcntl(port->fd, F_SETFL, O_NONBLOCK);
    (void)fcntl(port->fd, F_SETFD, FD_CLOEXEC);
    return true;
}

void port_close(struct port *port)
{
    if (port->fd >= 0) {
        (void)close(port->fd);
        port->fd = -1;
    }
    if (port->pid > 0) {
        (void)children_end(port->pid, CLOSE_PATIENCE_MS);
        port->pid = 0;
    }
    if (port->errors != NULL) {
        (void)fclose(port->errors);
        port->errors = NULL;
    }
}

/* The last line that what was started has said on its standard error. */
static void complaint_read(struct port *port, char out[COMPLAINT_MAX])
{
    char line[COMPLAINT_MAX];

    out[0] = '\0';
    if (port->errors == NULL) {
        return;
    }
    rewind(port->errors);
    while (fgets(line, sizeof line, port->errors) != NULL) {
        line[strcspn(line, "\r\n")] = '\0';
        if (line[0] != '\0') {
            (void)strcpy(out, line);
        }
    }
}

bool port_lose_board(struct port *port)
{
    char complaint[COMPLAINT_MAX];
    const int status = children_end(port->pid, DEATH_PATIENCE_MS);

    port->pid = 0;
    complaint_read(port, complaint);
    return port_fail(
        port, "the firmware %s %d%s%s", WIFSIGNALED(status) ? "was killed by signal" : "ended with exit code",
        WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status), complaint[0] != '\0' ? ": " : "", complaint);
}

/* What was started here tells why it is gone; of others the system's word is all there is. */
static ssize_t lose(struct port *port, int reason)
{
    if (port->pid != 0) {
        (void)port_lose_board(port);
    } else {
        (void)port_fail(port, "the other end is gone%s%s; is the device still there?", reason != 0 ? ": " : "",
                        reason != 0 ? strerror(reason) : "");
    }
    return -1;
}

static bool is_try_again(void) { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

ssize_t port_read(struct port *port, void *bytes, size_t size)
{
    if (port->fd < 0) {
        return -1;
    }
    const ssize_t count = read(port->fd, bytes, size);
    if (count > 0) {
        return count;
    }
    if (count < 0 && is_try_again()) {
        return 0;
    }
    /* A pseudo terminal whose other side has closed says EIO, which tells a person nothing. */
    return lose(port, count < 0 && errno != EIO && errno != ECONNRESET ? errno : 0);
}

ssize_t port_write(struct port *port, const void *bytes, size_t size)
{
    if (port->fd < 0) {
        return -1;
    }
    const ssize_t count = write(port->fd, bytes, size);
    if (count >= 0) {
        return count;
    }
    return is_try_again() ? 0 : lose(port, errno != EIO && errno != EPIPE && errno != ECONNRESET ? errno : 0);
}

bool port_wait(const struct port *port, bool wants_room, double limit_s)
{
    const double end_s = clock_now_s() + limit_s;
    struct pollfd end = {.fd = port->fd, .events = (short)(POLLIN | (wants_room ? POLLOUT : 0))};

    for (;;) {
        const double left_s = end_s - clock_now_s();
        const int left_ms = left_s <= 0.0 ? 0 : left_s > 60.0 ? 60000 : (int)(left_s * 1000.0) + 1;
        const int count = poll(&end, 1, left_ms);
        if (count > 0) {
            return true;
        }
        if ((count < 0 && errno != EINTR) || left_s <= 0.0) {
            return false;
        }
    }
}
