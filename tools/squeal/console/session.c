/* The conversation with the firmware's console. All three pipes are polled together: a firmware that talks while we
 * send would otherwise fill its pipe, stop reading, and both would wait for ever. */
#include "squeal/console/session.h"

#include "squeal/support/children.h"
#include "squeal/support/clock.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    DEATH_PATIENCE_MS = 500, /* its output has ended, so its exit code is about to come */
    CLOSE_PATIENCE_MS = 20,  /* its input has ended, which ends a host firmware but no emulator */
    OPEN_TRIES = 3,          /* a line may be damaged by what stood in the firmware's receiver before */
    READ_SIZE = 16384
};

static void close_end(int *end)
{
    if (*end >= 0) {
        (void)close(*end);
        *end = -1;
    }
}

__attribute__((format(printf, 2, 3))) static enum session_result lose(struct session *session, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    (void)vsnprintf(session->failure, sizeof session->failure, format, arguments);
    va_end(arguments);
    session_close(session);
    return SESSION_LOST;
}

/* Hands one whole line on. Returns true if it is the answer. */
static bool line_take(struct session *session, const char *line)
{
    enum session_line kind;
    size_t mark = 0;

    if (strncmp(line, "ok ", 3) == 0 || strcmp(line, "ok") == 0 || strncmp(line, "error ", 6) == 0) {
        memcpy(session->answer, line, strlen(line) + 1);
        return true;
    }
    if (strncmp(line, "- ", 2) == 0) {
        kind = SESSION_BODY;
        mark = 2;
    } else if (strncmp(line, "! ", 2) == 0) {
        kind = SESSION_NOTICE;
        mark = 2;
    } else if (line[0] == '#') {
        kind = SESSION_HEADER;
        mark = 1;
    } else if (isdigit((unsigned char)line[0])) {
        kind = SESSION_SAMPLE;
    } else {
        return false; /* a banner or our own echo */
    }
    if (session->listener != NULL) {
        session->listener(session->context, kind, line + mark);
    }
    return false;
}

/* Cuts the bytes into lines. Returns true if one of them was the answer. */
static bool bytes_take(struct session *session, const char *bytes, size_t count)
{
    bool is_answered = false;

    for (size_t i = 0; i < count; i++) {
        const char byte = bytes[i];
        if (byte != '\n' && byte != '\r') {
            if (byte != '\0' && session->line_length < sizeof session->line - 1) {
                session->line[session->line_length++] = byte;
            }
        } else if (session->line_length > 0) {
            session->line[session->line_length] = '\0';
            session->line_length = 0;
            is_answered = line_take(session, session->line) || is_answered;
        }
    }
    return is_answered;
}

/* Keeps the last line of stderr, and of a line too long its start. */
static void complaint_take(struct session *session, const char *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const unsigned char byte = (unsigned char)bytes[i];
        if (byte == '\n') {
            session->complaint_length = 0;
        } else if (session->complaint_length < sizeof session->complaint - 1) {
            session->complaint[session->complaint_length++] = (char)(byte < ' ' ? ' ' : byte);
            session->complaint[session->complaint_length] = '\0';
        }
    }
}

static void complaint_read(struct session *session)
{
    char bytes[1024];
    ssize_t count = 0;

    while (session->errors >= 0 && (count = read(session->errors, bytes, sizeof bytes)) > 0) {
        complaint_take(session, bytes, (size_t)count);
    }
    if (count == 0) {
        close_end(&session->errors);
    }
}

static enum session_result lose_dead(struct session *session)
{
    char how[64];
    struct pollfd errors = {.fd = session->errors, .events = POLLIN};

    close_end(&session->input);
    const int status = children_end(session->pid, DEATH_PATIENCE_MS);
    session->pid = 0;
    if (session->errors >= 0 && poll(&errors, 1, 0) > 0) {
        complaint_read(session);
    }
    if (WIFSIGNALED(status)) {
        (void)snprintf(how, sizeof how, "was killed by signal %d", WTERMSIG(status));
    } else {
        (void)snprintf(how, sizeof how, "ended with exit code %d", WEXITSTATUS(status));
    }
    if (session->complaint[0] != '\0') {
        return lose(session, "the firmware %s during '%s': %s", how, session->command, session->complaint);
    }
    return lose(session, "the firmware %s during '%s'", how, session->command);
}

/* Sends the text and takes what comes until the answer, the end of the firmware, or the limit. */
static enum session_result talk(struct session *session, const char *text, size_t length, double limit_s)
{
    static const char stop[] = "stop\n";
    double heard_s = clock_now_s(), end_s = heard_s + limit_s;
    size_t sent = 0;
    bool is_stopping = false;
    char bytes[READ_SIZE];

    for (;;) {
        if (session->is_unwanted != NULL && session->is_unwanted() && sent == length && !is_stopping) {
            is_stopping = true;
            text = stop;
            length = sizeof stop - 1;
            sent = 0;
        }
        struct pollfd ends[3] = {{.fd = session->output, .events = POLLIN},
                                 {.fd = session->errors, .events = POLLIN},
                                 {.fd = sent < length ? session->input : -1, .events = POLLOUT}};
        const double left_s = end_s - clock_now_s();
        if (left_s <= 0.0) {
            const double silent_s = clock_now_s() - heard_s;
            return silent_s > 0.5 * limit_s
                       ? lose(session, "the firmware was silent for %.0f s after '%s'", silent_s, session->command)
                       : lose(session, "the firmware did not answer '%s' within %g s", session->command, limit_s);
        }
        if (poll(ends, 3, (int)(left_s * 1000.0 < 60000.0 ? left_s * 1000.0 + 1.0 : 60000.0)) < 0 && errno != EINTR) {
            return lose(session, "poll: %s", strerror(errno));
        }
        if (ends[1].revents != 0) {
            complaint_read(session);
        }
        if (ends[0].revents != 0) {
            const ssize_t count = read(session->output, bytes, sizeof bytes);
            if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) {
                return lose_dead(session);
            }
            heard_s = clock_now_s();
            end_s = session->is_patient ? heard_s + limit_s : end_s;
            if (count > 0 && bytes_take(session, bytes, (size_t)count)) {
                return strncmp(session->answer, "ok", 2) == 0 ? SESSION_OK : SESSION_REFUSED;
            }
        }
        if (ends[2].revents != 0) {
            const ssize_t count = write(session->input, text + sent, length - sent);
            if (count > 0) {
                sent += (size_t)count;
            } else if (count < 0 && errno != EAGAIN && errno != EINTR) {
                return lose_dead(session);
            }
        }
    }
}

enum session_result session_command(struct session *session, double limit_s, const char *format, ...)
{
    char line[SESSION_COMMAND_MAX + 3];
    va_list arguments;

    if (session->pid == 0) {
        return SESSION_LOST;
    }
    va_start(arguments, format);
    const int length = vsnprintf(session->command, sizeof session->command, format, arguments);
    va_end(arguments);
    if (length < 0 || length > SESSION_COMMAND_MAX) {
        return lose(session, "a line of %d characters exceeds the console's %d", length, SESSION_COMMAND_MAX);
    }
    const int count = snprintf(line, sizeof line, "%s\n", session->command);
    const enum session_result result = talk(session, line, (size_t)count, limit_s);
    if (result == SESSION_OK) {
        const size_t verb = strcspn(session->command, " ");
        if (strncmp(session->answer, "ok ", 3) != 0 || strncmp(session->answer + 3, session->command, verb) != 0) {
            return lose(session, "'%s' got the answer of another command: %.100s", session->command, session->answer);
        }
    }
    return result;
}

static bool pipes_make(int pipes[3][2])
{
    for (int i = 0; i < 3; i++) {
        if (pipe(pipes[i]) != 0) {
            return false;
        }
        (void)fcntl(pipes[i][0], F_SETFD, FD_CLOEXEC);
        (void)fcntl(pipes[i][1], F_SETFD, FD_CLOEXEC);
    }
    return true;
}

enum session_result session_open(struct session *session, char *const argv[], session_listener listener, void *context)
{
    int pipes[3][2]; /* to its stdin, from its stdout, from its stderr */
    enum session_result result = SESSION_REFUSED;

    memset(session, 0, sizeof *session);
    session->input = session->output = session->errors = -1;
    session->listener = listener;
    session->context = context;
    if (!pipes_make(pipes)) {
        return lose(session, "pipe: %s", strerror(errno));
    }
    session->pid = children_start(argv, pipes[0][0], pipes[1][1], pipes[2][1]);
    const int reason = errno;
    (void)close(pipes[0][0]);
    (void)close(pipes[1][1]);
    (void)close(pipes[2][1]);
    session->input = pipes[0][1];
    session->output = pipes[1][0];
    session->errors = pipes[2][0];
    if (session->pid < 0) {
        session->pid = 0;
        return lose(session, reason == ENOENT ? "%s: command not found" : "%s: cannot be started", argv[0]);
    }
    (void)fcntl(session->input, F_SETFL, O_NONBLOCK);
    (void)fcntl(session->output, F_SETFL, O_NONBLOCK);
    (void)fcntl(session->errors, F_SETFL, O_NONBLOCK);
    for (int i = 0; i < OPEN_TRIES && result == SESSION_REFUSED; i++) {
        result = session_command(session, SESSION_START_S, "echo off");
    }
    return result == SESSION_REFUSED ? lose(session, "the firmware refuses 'echo off': %.100s", session->answer)
                                     : result;
}

void session_close(struct session *session)
{
    close_end(&session->input);
    if (session->pid > 0) {
        (void)children_end(session->pid, CLOSE_PATIENCE_MS);
        session->pid = 0;
    }
    close_end(&session->output);
    close_end(&session->errors);
}
