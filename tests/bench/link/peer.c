#include "peer.h"

#include <errno.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { PEERS_MAX = 4, BUSY_NS = 2000000, PAUSE_NS = 10000000, ECHO_MAX = 512 };

static volatile pid_t running[PEERS_MAX]; /* 0: a free place */

static uint64_t now_ns(void)
{
    struct timespec now;

    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

static void end_all(void)
{
    for (unsigned i = 0u; i < PEERS_MAX; i++) {
        if (running[i] != 0) {
            (void)kill(running[i], SIGKILL);
            (void)waitpid(running[i], NULL, 0);
            running[i] = 0;
        }
    }
}

static void end_by_signal(int number)
{
    end_all();
    _exit(128 + number);
}

/* As fork(), and the list knows of it. */
static pid_t start(void)
{
    static bool is_guarded;
    const pid_t pid = fork();

    if (pid == 0) {
        (void)signal(SIGINT, SIG_DFL);
        (void)signal(SIGTERM, SIG_DFL);
        memset((void *)running, 0, sizeof running);
        return 0;
    }
    if (!is_guarded) {
        (void)signal(SIGINT, end_by_signal);
        (void)signal(SIGTERM, end_by_signal);
        (void)signal(SIGPIPE, SIG_IGN);
        is_guarded = atexit(end_all) == 0;
    }
    for (unsigned i = 0u; i < PEERS_MAX && pid > 0; i++) {
        if (running[i] == 0) {
            running[i] = pid;
            break;
        }
    }
    return pid;
}

static bool has_ended(const struct peer *peer)
{
    siginfo_t info = {.si_pid = 0};

    return waitid(P_PID, (id_t)peer->pid, &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0;
}

static bool set_limits(struct peer *peer)
{
    const struct timeval limit = {.tv_sec = PEER_PATIENCE_S};

    return setsockopt(peer->socket, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit) == 0 &&
           setsockopt(peer->socket, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit) == 0;
}

static bool connect_to(struct peer *peer, const char *path)
{
    const struct timespec pause = {.tv_nsec = PAUSE_NS};
    const uint64_t until_ns = now_ns() + (uint64_t)PEER_PATIENCE_S * 1000000000u;
    struct sockaddr_un address = {.sun_family = AF_UNIX};

    if (strlen(path) >= sizeof address.sun_path) {
        fprintf(stderr, "%s: the name %s is too long for a socket\n", peer->name, path);
        return false;
    }
    strcpy(address.sun_path, path);
    while (now_ns() < until_ns && !has_ended(peer)) {
        peer->socket = socket(AF_UNIX, SOCK_STREAM, 0);
        if (connect(peer->socket, (const struct sockaddr *)&address, sizeof address) == 0) {
            return set_limits(peer);
        }
        (void)close(peer->socket);
        (void)nanosleep(&pause, NULL);
    }
    fprintf(stderr, "%s: does not listen at %s\n", peer->name, path);
    return false;
}

/* Its console is nobody's: it reads nothing, and what it prints goes nowhere. */
static void become(char **argv, const char *path)
{
    char where[256];
    const int nothing = open("/dev/null", O_RDWR);

    (void)snprintf(where, sizeof where, "unix:%s", path);
    (void)setenv("SQUEAL_LINK", where, 1);
    (void)dup2(nothing, STDIN_FILENO);
    (void)dup2(nothing, STDOUT_FILENO);
    (void)dup2(nothing, STDERR_FILENO);
    (void)execvp(argv[0], argv);
    _exit(127);
}

bool peer_start(struct peer *peer, char **argv, const char *path)
{
    (void)unlink(path);
    peer->pid = start();
    if (peer->pid == 0) {
        become(argv, path);
    }
    return peer->pid > 0 && connect_to(peer, path);
}

static void echo(int socket, size_t asked, size_t answered)
{
    static uint8_t bytes[ECHO_MAX];

    while (recv(socket, bytes, asked, MSG_WAITALL) == (ssize_t)asked &&
           send(socket, bytes, answered, 0) == (ssize_t)answered) {
    }
    _exit(0);
}

bool peer_echo(struct peer *peer, size_t asked, size_t answered)
{
    int ends[2];

    if (asked > ECHO_MAX || answered > ECHO_MAX || socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) {
        return false;
    }
    peer->pid = start();
    if (peer->pid == 0) {
        (void)close(ends[0]);
        echo(ends[1], asked, answered);
    }
    (void)close(ends[1]);
    peer->socket = ends[0];
    return peer->pid > 0 && set_limits(peer);
}

bool peer_send(struct peer *peer, const void *data, size_t size)
{
    if (send(peer->socket, data, size, MSG_NOSIGNAL) == (ssize_t)size) {
        return true;
    }
    fprintf(stderr, "%s: takes no bytes: %s\n", peer->name, strerror(errno));
    return false;
}

size_t peer_receive(struct peer *peer, void *data, size_t capacity)
{
    const uint64_t until_ns = now_ns() + BUSY_NS;
    ssize_t count = -1;

    while (peer->is_busy && count < 0 && now_ns() < until_ns) {
        count = recv(peer->socket, data, capacity, MSG_DONTWAIT);
        (void)sched_yield(); /* The peer may need the very processor that we wait on. */
    }
    if (count < 0) {
        count = recv(peer->socket, data, capacity, 0);
    }
    if (count > 0) {
        return (size_t)count;
    }
    fprintf(stderr, "%s: %s\n", peer->name, count == 0 ? "has ended" : "no answer in time");
    return 0u;
}

void peer_end(struct peer *peer)
{
    for (unsigned i = 0u; i < PEERS_MAX; i++) {
        if (peer->pid > 0 && running[i] == peer->pid) {
            (void)close(peer->socket);
            (void)kill(peer->pid, SIGKILL);
            (void)waitpid(peer->pid, NULL, 0);
            running[i] = 0;
        }
    }
}
