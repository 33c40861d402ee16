/* A firmware that is started for the port: its link is a socket in a folder of its own, which is gone as soon as it is
 * connected. */
#include "squeal/port/port_parts.h"

#include "squeal/port/boards.h"
#include "squeal/support/children.h"
#include "squeal/support/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define START_S 30.0 /* an emulator on a busy machine is slow to start */

enum { PATH_SIZE = 80, LOOK_AGAIN_MS = 2 };

static bool start(struct port *port, char **command)
{
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);

    port->errors = tmpfile();
    if (nothing < 0 || port->errors == NULL) {
        return port_fail(port, "%s", strerror(errno));
    }
    (void)fcntl(fileno(port->errors), F_SETFD, FD_CLOEXEC);
    port->pid = children_start(command, nothing, nothing, fileno(port->errors));
    const int reason = errno;
    (void)close(nothing);
    if (port->pid < 0) {
        port->pid = 0;
        return port_fail(port,
                         reason == ENOENT ? "%s: command not found; make setup installs it" : "%s: cannot be started",
                         command[0]);
    }
    return true;
}

static bool await_link(struct port *port, const char *link)
{
    const struct timespec pause = {0, LOOK_AGAIN_MS * 1000000L};
    const double end_s = clock_now_s() + START_S;

    while ((port->fd = port_connect_unix(link)) < 0) {
        if (children_has_ended(port->pid)) {
            return port_lose_board(port);
        }
        if (clock_now_s() > end_s) {
            return port_fail(port, "the firmware did not open its link within %.0f s", START_S);
        }
        (void)nanosleep(&pause, NULL);
    }
    return true;
}

bool port_open_board(struct port *port)
{
    const char *temporary = getenv("TMPDIR");
    char folder[PATH_SIZE], link[PATH_SIZE + 8], problem[BOARDS_PROBLEM_MAX];

    /* mkdtemp() puts letters of its own in the place of the last six. */
    (void)snprintf(folder, sizeof folder, "%s/squeal-XXXXXX",
                   temporary != NULL && strlen(temporary) < PATH_SIZE - 16 ? temporary : "/tmp");
    if (!children_make_folder(folder)) {
        return port_fail(port, "%s: %s", folder, strerror(errno));
    }
    (void)snprintf(link, sizeof link, "%s/" CHILDREN_LINK, folder);
    char **command = boards_command(port->name, link, problem);
    const bool is_open =
        command != NULL ? start(port, command) && await_link(port, link) : port_fail(port, "%s", problem);
    free(command);
    children_remove_folder();
    return is_open;
}
