/* The processes that must not outlive this one. */
#include "squeal/support/children.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { CHILDREN_MAX = 64, POLL_MS = 5, TERMINATION_MS = 500, PATH_SIZE = 256 };

struct child {
    volatile pid_t pid; /* 0 marks a free place */
    volatile sig_atomic_t own_group;
};

static const int ending_signals[] = {SIGINT, SIGTERM, SIGHUP};
static struct child children[CHILDREN_MAX];
static volatile sig_atomic_t interrupt_is_held, interrupt_is_noted;

static struct {
    char path[PATH_SIZE], file[PATH_SIZE];
    volatile sig_atomic_t is_there;
} folder;

static void child_kill(const struct child *child, int number)
{
    (void)kill(child->own_group ? -child->pid : child->pid, number);
}

/* Only calls that are safe inside a signal handler. */
void children_remove_folder(void)
{
    if (folder.is_there != 0) {
        folder.is_there = 0;
        (void)unlink(folder.file);
        (void)rmdir(folder.path);
    }
}

/* Only calls that are safe inside a signal handler. A worker is asked to end, since it has a child of its own to end.
 */
static void ending_handler(int number)
{
    if (number == SIGINT && interrupt_is_held != 0 && interrupt_is_noted == 0) {
        interrupt_is_noted = 1;
        return;
    }
    for (int i = 0; i < CHILDREN_MAX; i++) {
        if (children[i].pid != 0) {
            child_kill(&children[i], children[i].own_group ? SIGKILL : SIGTERM);
        }
    }
    for (int i = 0; i < CHILDREN_MAX; i++) {
        if (children[i].pid != 0) {
            (void)waitpid(children[i].pid, NULL, 0);
        }
    }
    children_remove_folder();
    (void)signal(number, SIG_DFL);
    (void)raise(number);
}

static void signals_block(sigset_t *before)
{
    sigset_t ending;

    (void)sigemptyset(&ending);
    for (size_t i = 0; i < sizeof ending_signals / sizeof ending_signals[0]; i++) {
        (void)sigaddset(&ending, ending_signals[i]);
    }
    (void)sigprocmask(SIG_BLOCK, &ending, before);
}

static struct child *child_find(pid_t pid)
{
    for (int i = 0; i < CHILDREN_MAX; i++) {
        if (children[i].pid == pid) {
            return &children[i];
        }
    }
    return NULL;
}

static void signals_default(void)
{
    for (size_t i = 0; i < sizeof ending_signals / sizeof ending_signals[0]; i++) {
        (void)signal(ending_signals[i], SIG_DFL);
    }
    (void)signal(SIGPIPE, SIG_DFL);
}

void children_guard(void)
{
    struct sigaction action = {0};

    action.sa_handler = ending_handler;
    (void)sigfillset(&action.sa_mask);
    for (size_t i = 0; i < sizeof ending_signals / sizeof ending_signals[0]; i++) {
        (void)sigaction(ending_signals[i], &action, NULL);
    }
    (void)signal(SIGPIPE, SIG_IGN);
}

pid_t children_fork(bool own_group)
{
    struct child *place = child_find(0);
    sigset_t before;

    if (place == NULL) {
        errno = EAGAIN;
        return -1;
    }
    signals_block(&before);
    const pid_t pid = fork();
    if (pid == 0) {
        for (int i = 0; i < CHILDREN_MAX; i++) {
            children[i].pid = 0;
        }
        folder.is_there = 0;
        if (own_group) {
            (void)setpgid(0, 0);
        }
        signals_default();
    } else if (pid > 0) {
        /* Both sides set the group, so that it exists whichever of them runs first. */
        if (own_group) {
            (void)setpgid(pid, pid);
        }
        place->own_group = own_group ? 1 : 0;
        place->pid = pid;
    }
    (void)sigprocmask(SIG_SETMASK, &before, NULL);
    return pid;
}

/* In the child: becomes the program, or reports over status why it cannot. */
static void become(char *const argv[], int input, int output, int errors, int status)
{
    if (dup2(input, STDIN_FILENO) >= 0 && dup2(output, STDOUT_FILENO) >= 0 && dup2(errors, STDERR_FILENO) >= 0) {
        (void)execvp(argv[0], argv);
    }
    const int reason = errno;
    const ssize_t ignored = write(status, &reason, sizeof reason);
    _exit(ignored > 0 ? 126 : 127);
}

pid_t children_start(char *const argv[], int input, int output, int errors)
{
    int status[2], reason = 0;

    if (pipe(status) != 0) {
        return -1;
    }
    (void)fcntl(status[0], F_SETFD, FD_CLOEXEC);
    (void)fcntl(status[1], F_SETFD, FD_CLOEXEC);
    const pid_t pid = children_fork(true);
    if (pid == 0) {
        become(argv, input, output, errors, status[1]);
    }
    reason = errno;
    (void)close(status[1]);
    /* exec closes the other end, and nothing comes. */
    const ssize_t count = pid > 0 ? read(status[0], &reason, sizeof reason) : -1;
    (void)close(status[0]);
    if (count == 0) {
        return pid;
    }
    (void)children_wait(pid);
    errno = reason;
    return -1;
}

bool children_has_ended(pid_t pid)
{
    siginfo_t info = {0};

    return waitid(P_PID, (id_t)pid, &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid;
}

bool children_make_folder(char *path)
{
    sigset_t before;

    if (strlen(path) + sizeof "/" CHILDREN_LINK > PATH_SIZE) {
        errno = ENAMETOOLONG;
        return false;
    }
    signals_block(&before);
    const bool is_made = mkdtemp(path) != NULL;
    if (is_made) {
        (void)snprintf(folder.path, PATH_SIZE, "%s", path);
        (void)snprintf(folder.file, PATH_SIZE, "%s/" CHILDREN_LINK, path);
        folder.is_there = 1;
    }
    (void)sigprocmask(SIG_SETMASK, &before, NULL);
    return is_made;
}

void children_hold_interrupt(bool is_held)
{
    if (is_held) {
        interrupt_is_noted = 0;
    }
    interrupt_is_held = is_held ? 1 : 0;
}

bool children_is_interrupted(void) { return interrupt_is_noted != 0; }

/* Reaps under blocked signals: between waitpid and the removal the handler would meet a number that is no longer ours.
 */
static bool child_reap(struct child *child, int *status)
{
    sigset_t before;

    signals_block(&before);
    const pid_t done = waitpid(child->pid, status, WNOHANG);
    const bool is_gone = done == child->pid || (done < 0 && errno == ECHILD);
    if (is_gone) {
        if (child->own_group) {
            child_kill(child, SIGKILL);
        }
        child->pid = 0;
    }
    (void)sigprocmask(SIG_SETMASK, &before, NULL);
    return is_gone;
}

static void sleep_ms(int milliseconds)
{
    const struct timespec pause = {milliseconds / 1000, (long)(milliseconds % 1000) * 1000000L};

    (void)nanosleep(&pause, NULL);
}

static bool child_await(struct child *child, int patience_ms, int *status)
{
    for (int waited_ms = 0; !child_reap(child, status); waited_ms += POLL_MS) {
        if (waited_ms >= patience_ms) {
            return false;
        }
        sleep_ms(POLL_MS);
    }
    return true;
}

int children_end(pid_t pid, int patience_ms)
{
    struct child *child = child_find(pid);
    int status = 0;

    if (pid <= 0 || child == NULL || child_await(child, patience_ms, &status)) {
        return status;
    }
    child_kill(child, SIGTERM);
    if (child_await(child, TERMINATION_MS, &status)) {
        return status;
    }
    child_kill(child, SIGKILL);
    return children_wait(pid);
}

int children_wait(pid_t pid)
{
    struct child *child = child_find(pid);
    int status = 0;

    if (pid <= 0 || child == NULL) {
        return 0;
    }
    /* Polled, because the signals stay blocked during each look. */
    while (!child_reap(child, &status)) {
        sleep_ms(POLL_MS);
    }
    return status;
}
