/* What the tool's exit code says. A signal ends it as it ends any other program. */
#ifndef SQUEAL_EXITS_H
#define SQUEAL_EXITS_H

enum {
    EXIT_OK = 0,
    EXIT_FAILED = 1,  /* something failed, or differs from what it is compared with */
    EXIT_USAGE = 2,   /* the command line is wrong */
    EXIT_PORT = 3,    /* the port cannot be opened, nobody answers there, or it is gone */
    EXIT_REFUSED = 4, /* the device refused what was asked of it */
};

#endif
