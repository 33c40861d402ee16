/* What the console's parts share: answers and the steps of a task. Not for anybody else. */
#ifndef PROTOCOL_CONSOLE_PARTS_H
#define PROTOCOL_CONSOLE_PARTS_H

#include "protocol/console.h"
#include "protocol/token.h"

/* Answers. An answer is begun, gets its fields, and is ended; an error likewise. Beginning an error counts it. */
void console_begin_ok(struct console *console);
void console_begin_error(struct console *console, enum error error);
void console_end(struct console *console);

/* A whole answer: the error, the word to blame (may be of length 0), and why. */
void console_refuse(struct console *console, enum error error, struct token word, const char *why);

/* "error usage <command and its arguments>" */
void console_refuse_usage(struct console *console);

/* "error out-of-range <key>=<word>: <low> .. <high>, a whole number" */
void console_refuse_count(struct console *console, const char *key, struct token word, uint32_t low, uint32_t high);

/* Reads a number in low .. high. If it is none, "error usage", "bad-number" or "out-of-range <key>=<word>: <low> ..
 * <high>" has been answered, and false comes back. */
bool console_read_number(struct console *console, const char *key, struct token word, float low, float high,
                         float *value);

/* Has the plant left its domain, and is frozen? */
bool console_is_in_fault(const struct console *console);

/* "error in-fault", with step and time. */
void console_refuse_fault(struct console *console);

/* A body line is begun and ended. */
void console_begin_body(struct console *console);

/* Starts a task: its answer comes later. */
void console_start_task(struct console *console, enum console_task task);

/* Does a sample wait that is the console's to write? */
bool console_has_sample(const struct console *console);

/* The present task has been answered. */
void console_end_task(struct console *console);

/* So many steps from where the plant stands; they are granted as tasks_continue() goes on. */
void console_begin_steps(struct console *console, uint64_t steps);

enum console_progress { CONSOLE_WAITS, CONSOLE_ADVANCES, CONSOLE_IS_DONE, CONSOLE_FAULTS };

/* Grants steps, at most slice at a time, and says how far it is. DONE when all are made, reported, and their samples
 * written. *report is the latest. */
enum console_progress console_go_on(struct console *console, uint32_t slice, struct executive_report *report);

/* Goes on with the task under way; returns true if something was done. */
bool console_task_continue(struct console *console);

/* Stops the plant, with an order that makes the interrupt report where it stands. */
void console_halt(struct console *console);

/* Commands with a file of their own: the stream, */
void streaming_obey(struct console *console);
void streaming_begin(struct console *console);

/* Can the stream under way go on with this set's tick and substeps? If not, that has been answered. */
bool streaming_admits(struct console *console, const struct params *params);

/* a controller's part by hand, */
void steering_obey(struct console *console);

/* what needs no integration, */
void analyse_obey(struct console *console);

/* and the set. */
void settings_list(struct console *console);
void settings_get(struct console *console);
void settings_set(struct console *console);
void settings_table(struct console *console);
void settings_preset(struct console *console);
void settings_defaults(struct console *console);
void settings_reset(struct console *console);

/* "error bad-number|out-of-range <symbol>=<word>: <what would do>" */
void settings_refuse_value(struct console *console, enum error error, const struct params_info *info,
                           struct token word);

/* Orders a change to this set, whose answer comes later; or refuses it. */
void settings_order(struct console *console, const struct params *params);

/* " <name> points=<n>" of the table that the arguments name. */
void settings_write_table(struct console *console);

void settings_answer(struct console *console, const struct executive_report *report);

#endif
