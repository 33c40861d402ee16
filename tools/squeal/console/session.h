/* A conversation with one firmware: starts its command line, sends console lines, waits for the one answer of each. */
#ifndef SQUEAL_SESSION_H
#define SQUEAL_SESSION_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

enum session_line {
    SESSION_BODY,   /* "- " of the answer that follows; the text comes without the mark */
    SESSION_NOTICE, /* "! " that nobody asked for; without the mark */
    SESSION_HEADER, /* "#" of a CSV stream; without the mark */
    SESSION_SAMPLE  /* one line of a CSV stream */
};

enum session_result {
    SESSION_OK,
    SESSION_REFUSED, /* the firmware answered error; it is in answer, and the conversation goes on */
    SESSION_LOST     /* no answer will come; failure says why in one line, only session_close is left */
};

/* Called for each line that is not the answer, in the order of arrival. */
typedef void (*session_listener)(void *context, enum session_line kind, const char *text);

enum {
    SESSION_COMMAND_MAX = 240, /* characters of a line that the firmware takes */
    SESSION_LINE_MAX = 4096,
    SESSION_START_S = 30
};

struct session {
    pid_t pid;
    int input; /* ends of our pipes; -1 once closed */
    int output;
    int errors;
    session_listener listener;
    void *context;
    bool is_patient;           /* whatever the firmware says gives its answer the whole limit again */
    bool (*is_unwanted)(void); /* asked while an answer is awaited, if not NULL; see session_command */
    char command[SESSION_COMMAND_MAX + 2];
    char line[SESSION_LINE_MAX]; /* the line being received */
    size_t line_length;
    char answer[SESSION_LINE_MAX]; /* the last answer, from its ok or error on */
    char complaint[256];           /* the last line that came over its stderr */
    size_t complaint_length;
    char failure[512]; /* why the session is lost, one line */
};

/* Starts argv[0] with its arguments and turns its echo off, for which it gets SESSION_START_S, since an emulator on a
 * busy machine is slow to start. The listener may be NULL. On SESSION_LOST failure is set and nothing is left
 * running. */
enum session_result session_open(struct session *session, char *const argv[], session_listener listener, void *context);

/* Sends one line and waits at most limit_s for its answer. While it waits it takes whatever the firmware says, so the
 * two never block each other. If the answer becomes unwanted, one "stop" is sent behind the line; its own answer is not
 * waited for, so that only session_close is left then. */
enum session_result session_command(struct session *session, double limit_s, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Ends the firmware, if it still runs, and reaps it. May be called twice. */
void session_close(struct session *session);

#endif
