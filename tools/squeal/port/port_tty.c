/* Terminals: serial lines, pseudo terminals by name, and a new pseudo terminal that waits for its other end. */
#include "squeal/port/port_parts.h"

#include <errno.h>
#include <fcntl.h>
#include <glob.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

enum { PATH_SIZE = PORT_NAME_MAX, LOOK_AGAIN_MS = 20 };

#define BAUD_DEFAULT 921600L

#define RATES(RATE) \
    RATE(9600)      \
    RATE(19200)     \
    RATE(38400)     \
    RATE(57600) RATE(115200) RATE(230400) RATE(460800) RATE(921600) RATE(1000000) RATE(1500000) RATE(2000000)

static const struct {
    long baud;
    speed_t speed;
} rates[] = {
#define RATE(baud) {baud, B##baud},
    RATES(RATE)
#undef RATE
};

#define RATE(baud) " " #baud
static const char rates_text[] = RATES(RATE);
#undef RATE

static bool speed_of(long baud, speed_t *speed)
{
    for (size_t i = 0; i < sizeof rates / sizeof rates[0]; i++) {
        if (rates[i].baud == baud) {
            *speed = rates[i].speed;
            return true;
        }
    }
    return false;
}

/* A terminal that passes all bytes as they are. False with errno. */
static bool set_raw(int fd, long baud)
{
    struct termios line;
    speed_t speed = B0;

    if (tcgetattr(fd, &line) != 0) {
        return false;
    }
    line.c_iflag = 0;
    line.c_oflag = 0;
    line.c_lflag = 0;
    line.c_cflag = CS8 | CREAD | CLOCAL; /* and no HUPCL: who closes the port does not reset the board */
    line.c_cc[VMIN] = 1;
    line.c_cc[VTIME] = 0;
    if (!speed_of(baud, &speed) || cfsetispeed(&line, speed) != 0 || cfsetospeed(&line, speed) != 0) {
        errno = EINVAL;
        return false;
    }
    return tcsetattr(fd, TCSANOW, &line) == 0;
}

/* Cuts "path:baud". A path may hold colons itself, so what exists as it stands is a path. */
static long rate_cut(char *path)
{
    struct stat status;
    char *colon = strrchr(path, ':');

    if (stat(path, &status) == 0 || colon == NULL || colon[1] == '\0' ||
        strspn(colon + 1, "0123456789") != strlen(colon + 1)) {
        return BAUD_DEFAULT;
    }
    *colon = '\0';
    return strtol(colon + 1, NULL, 10);
}

/* Serial lines that this machine has, for who named one that it has not. */
static bool fail_missing(struct port *port)
{
    char there[PORT_PROBLEM_MAX / 2] = "";
    size_t length = 0;
    glob_t found;

    if (glob("/dev/ttyUSB*", 0, NULL, &found) == 0 || glob("/dev/ttyACM*", 0, NULL, &found) == 0) {
        for (size_t i = 0; i < found.gl_pathc && length < sizeof there; i++) {
            length += (size_t)snprintf(there + length, sizeof there - length, " %s", found.gl_pathv[i]);
        }
        globfree(&found);
    }
    return port_fail(port, there[0] != '\0' ? "no such device; there are%s" : "no such device; is it plugged in?%s",
                     there);
}

static bool fail_to_open(struct port *port)
{
    if (errno == ENOENT || errno == ENODEV || errno == ENXIO) {
        return fail_missing(port);
    }
    if (errno == EACCES) {
        return port_fail(port, "permission denied; the group of the device, often dialout, must hold you");
    }
    if (errno == EBUSY) {
        return port_fail(port, "busy: another program has it; end that one");
    }
    return port_fail(port, "%s", strerror(errno));
}

bool port_open_tty(struct port *port, const char *where)
{
    char path[PATH_SIZE];
    speed_t speed;

    (void)snprintf(path, sizeof path, "%s", where);
    const long baud = rate_cut(path);
    if (!speed_of(baud, &speed)) {
        return port_fail(port, "no rate of %ld baud; there are%s", baud, rates_text);
    }
    port->fd = open(path, O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (port->fd < 0) {
        return fail_to_open(port);
    }
    if (isatty(port->fd) != 1) {
        return port_fail(port, "no serial line; a socket is named unix:PATH");
    }
    /* The lock tells programs that look for it, the exclusive mode those that do not. */
    if (flock(port->fd, LOCK_EX | LOCK_NB) != 0) {
        errno = EBUSY;
        return fail_to_open(port);
    }
    (void)ioctl(port->fd, TIOCEXCL);
    if (!set_raw(port->fd, baud)) {
        return port_fail(port, "cannot be set to %ld baud: %s", baud, strerror(errno));
    }
    (void)tcflush(port->fd, TCIOFLUSH);
    return true;
}

/* On the side that stays here a closed other end shows as a hang-up. */
static bool is_open_elsewhere(int fd)
{
    struct pollfd end = {.fd = fd, .events = POLLIN};

    return poll(&end, 1, 0) >= 0 && (end.revents & POLLHUP) == 0;
}

bool port_open_pty(struct port *port)
{
    const struct timespec pause = {0, LOOK_AGAIN_MS * 1000000L};

    port->fd = posix_openpt(O_RDWR | O_NOCTTY);
    const char *name = port->fd >= 0 && grantpt(port->fd) == 0 && unlockpt(port->fd) == 0 ? ptsname(port->fd) : NULL;
    const int other = name != NULL ? open(name, O_RDWR | O_NOCTTY) : -1;
    if (other < 0 || !set_raw(other, BAUD_DEFAULT)) {
        return port_fail(port, "no pseudo terminal to be had: %s", strerror(errno));
    }
    (void)close(other);
    (void)snprintf(port->name, sizeof port->name, "%s", name);
    fprintf(stderr, "squeal: waiting for a program to open %s\n", name);
    while (!is_open_elsewhere(port->fd)) {
        (void)nanosleep(&pause, NULL);
    }
    return true;
}
