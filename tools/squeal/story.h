/* The subcommand run: the device tells its story act by act; the tool prints it for a person and keeps the record. */
#ifndef SQUEAL_STORY_H
#define SQUEAL_STORY_H

int story_main(int argc, char **argv);

#endif
