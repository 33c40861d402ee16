/* Keeps the list of processes that this one started, so that none outlives it: on SIGINT, SIGTERM and SIGHUP they are
 * ended and reaped before the signal takes its usual course. One list a process, because a signal has one handler. */
#ifndef SQUEAL_CHILDREN_H
#define SQUEAL_CHILDREN_H

#include <stdbool.h>
#include <sys/types.h>

/* Installs the handlers. Called once, by main. A write to a process that has ended then fails instead of killing us. */
void children_guard(void);

/* Starts a process as fork does, and puts it on the list; with its own process group, if asked, so that whatever it
 * starts ends with it. In the child the list is empty and signals are as they were before children_guard. */
pid_t children_fork(bool own_group);

/* While it is held, the first SIGINT is only noted, so that what is under way can be ended in words; another one takes the
 * usual course. */
void children_hold_interrupt(bool is_held);

/* Was one noted since the last children_hold_interrupt(true)? */
bool children_is_interrupted(void);

/* Waits at most patience_ms for the process to end by itself, then asks it to, then kills it. Returns the status that
 * waitpid gave. */
int children_end(pid_t pid, int patience_ms);

/* Waits until the process ends by itself. Returns the status that waitpid gave. */
int children_wait(pid_t pid);

#endif
