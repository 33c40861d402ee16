/* What is changed here is undone by one function, which signal handlers may call. */
#include "squeal/monitor/terminal.h"

#include <ctype.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

/* Alternate screen, no cursor, no wrapping at the right edge; and back. */
static const char enter[] = "\033[?1049h\033[?25l\033[?7l";
static const char leave[] = "\033[?2026l\033[m\033[?7h\033[?25h\033[?1049l";

static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

enum { SIGNALS = sizeof signals / sizeof signals[0] };

static struct {
    volatile sig_atomic_t is_taken;
    struct termios before;
    struct sigaction handlers[SIGNALS];
} terminal;

static const char *variable(const char *name)
{
    const char *value = getenv(name);

    return value != NULL ? value : "";
}

bool terminal_can_draw(void)
{
    const char *type = variable("TERM");

    return isatty(STDIN_FILENO) && isatty(STDOUT_FILENO) && type[0] != '\0' && strcmp(type, "dumb") != 0;
}

/* The locale's character set, where it is named, in lower case. */
static bool is_utf8(void)
{
    const char *locale = variable("LC_ALL")[0] != '\0'     ? variable("LC_ALL")
                         : variable("LC_CTYPE")[0] != '\0' ? variable("LC_CTYPE")
                                                           : variable("LANG");
    const char *set = strchr(locale, '.');

    if (set == NULL) {
        return true; /* it does not say; most do */
    }
    return tolower((unsigned char)set[1]) == 'u' && tolower((unsigned char)set[2]) == 't' &&
           tolower((unsigned char)set[3]) == 'f';
}

struct screen_style terminal_style(void)
{
    const char *type = variable("TERM");
    const bool is_rich = strstr(type, "256") != NULL || variable("COLORTERM")[0] != '\0';
    const bool is_console = strcmp(type, "linux") == 0; /* its font has no such dots */

    return (struct screen_style){variable("NO_COLOR")[0] != '\0' ? 0u : is_rich ? 256u : 16u, is_console || !is_utf8()};
}

static void say(const char *text, size_t size)
{
    while (size > 0u) {
        const ssize_t count = write(STDOUT_FILENO, text, size);

        if (count < 0 && errno != EINTR) {
            return; /* nobody is there to see it */
        }
        text += count > 0 ? count : 0;
        size -= count > 0 ? (size_t)count : 0u;
    }
}

/* Only calls that are safe inside a signal handler. */
void terminal_give_back(void)
{
    if (terminal.is_taken != 0) {
        terminal.is_taken = 0;
        say(leave, sizeof leave - 1u);
        (void)tcsetattr(STDIN_FILENO, TCSAFLUSH, &terminal.before);
    }
}

static void ending_handler(int number)
{
    terminal_give_back();
    for (int i = 0; i < SIGNALS; i++) {
        if (signals[i] == number) {
            (void)sigaction(number, &terminal.handlers[i], NULL);
        }
    }
    (void)raise(number); /* comes when this handler has returned */
}

bool terminal_take(void)
{
    struct sigaction action = {0};
    struct termios raw;

    if (tcgetattr(STDIN_FILENO, &terminal.before) != 0) {
        return false;
    }
    action.sa_handler = ending_handler;
    (void)sigfillset(&action.sa_mask);
    for (int i = 0; i < SIGNALS; i++) {
        struct sigaction before;

        (void)sigaction(signals[i], &action, &before);
        if (before.sa_handler != ending_handler) {
            terminal.handlers[i] = before;
        }
    }
    raw = terminal.before;
    raw.c_iflag &= ~(tcflag_t)(BRKINT | ICRNL | INLCR | IGNCR | ISTRIP | IXON | PARMRK);
    raw.c_lflag &= ~(tcflag_t)(ECHO | ECHONL | ICANON | IEXTEN | ISIG);
    raw.c_cc[VMIN] = 1;
    raw.c_cc[VTIME] = 0;
    terminal.is_taken = 1;
    if (tcsetattr(STDIN_FILENO, TCSAFLUSH, &raw) != 0) {
        terminal.is_taken = 0;
        return false;
    }
    say(enter, sizeof enter - 1u);
    return true;
}

void terminal_suspend(void)
{
    terminal_give_back();
    (void)raise(SIGTSTP);
    (void)terminal_take();
}

void terminal_size(int *rows, int *cols)
{
    struct winsize size;
    const bool is_known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 0 && size.ws_col > 0;

    *rows = is_known ? size.ws_row : 24;
    *cols = is_known ? size.ws_col : 80;
}
