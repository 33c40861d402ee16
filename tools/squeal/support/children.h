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

/* Starts argv[0] with its arguments in a process group of its own, these three as its standard input, output and error.
 * -1 with errno if it cannot be started. */
pid_t children_start(char *const argv[], int input, int output, int errors);

/* Has it ended by itself? It is still to be reaped. */
bool children_has_ended(pid_t pid);

/* Makes a folder from a template as mkdtemp does, for one file that is called CHILDREN_LINK; one such folder at a time.
 * Both go with children_remove_folder(), or before a signal ends this process. False with errno. */
#define CHILDREN_LINK "link"
bool children_make_folder(char *path);
void children_remove_folder(void);

/* While it is held, the first SIGINT is only noted, so that what is under way can be ended in words; another one takes
 * the usual course. */
void children_hold_interrupt(bool is_held);

/* Was one noted since the last children_hold_interrupt(true)? */
bool children_is_interrupted(void);

/* Waits at most patience_ms for the process to end by itself, then asks it to, then kills it. Returns the status that
 * waitpid gave. */
int children_end(pid_t pid, int patience_ms);

/* Waits until the process ends by itself. Returns the status that waitpid gave. */
int children_wait(pid_t pid);

#endif
