/* From a line to what it does: the table is commands.def. */
#ifndef PROTOCOL_COMMANDS_H
#define PROTOCOL_COMMANDS_H

#include "protocol/console.h"

enum {
#define TABLE_VERSION(version) COMMANDS_VERSION = version
#define COMMAND(...)
#include "protocol/commands.def"
#undef COMMAND
};

/* Obeys the line in console->command: answers it, or starts a task that will. [MAIN] */
void commands_obey(struct console *console);

#endif
