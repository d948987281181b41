/* SPDX-License-Identifier: MIT
 * main.c - runs one session in simulated time: simtime_session FOLDER [--show] < actions
 *
 * FOLDER holds the programs (libsimtime-play.so, libsimtime-edit.so). A line of the list is "TICK VERB WORDS";
 * README.md lists the verbs. Prints "ticks N", a line "mark COUNT NAME" for each place reached, and "fault RULE:
 * what happened" for a broken rule; the exit status is then 1. */
#include "session.h"

#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

enum { EXIT_FAULT = 1, EXIT_USAGE = 2, HANG_S = 20, STARTS_MAX = 400, PATH_BYTES = 512, GOAL_COMES = 3 * SECOND };

session_t session;

typedef struct {
    uint32_t tick;
    char *words;
} action_t;

static struct {
    action_t *action;
    unsigned count, next;
    bool switch_image;
    bool waits;                    /* for a goal; delays the actions after it */
    uint32_t late, waits_since;
} list;

/* ---- the end ---- */

static void print_figures(void)
{
    printf("ticks %u\n", session.tick);
    marks_print();
}

void session_fail(const char *rule, const char *format, ...)
{
    va_list arguments;
    print_figures();
    printf("fault %s at tick %u: ", rule, session.tick);
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    printf("\n");
    fflush(stdout);
    _exit(EXIT_FAULT);
}

static void on_signal(int number)
{
    if (number == SIGVTALRM) {
        session_fail("answers", "the program runs without end");
    }
    session_fail("crash", "%s", strsignal(number));
}

uint32_t session_random(void)
{
    session.random = session.random * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(session.random >> 33);
}

/* ---- the list ---- */

static void read_list(void)
{
    char *text = NULL;
    size_t room = 0;
    ssize_t length;
    while ((length = getline(&text, &room, stdin)) > 0) {
        int at = 0;
        unsigned tick = 0;
        text[strcspn(text, "\n")] = '\0';
        if (text[0] == '#' || text[0] == '\0') {
            continue;
        }
        list.action = realloc(list.action, (list.count + 1) * sizeof *list.action);
        if (list.action == NULL || sscanf(text, "%u %n", &tick, &at) != 1) {
            fprintf(stderr, "simtime_session: not an action: %s\n", text);
            exit(EXIT_USAGE);
        }
        list.action[list.count++] = (action_t){tick, strdup(text + at)};
    }
    free(text);
}

static void take(char *words)
{
    unsigned number;
    if (sscanf(words, "seed %u", &number) == 1) {
        session.random = number;
    } else if (strcmp(words, "image play") == 0 || strcmp(words, "image edit") == 0) {
        list.switch_image = session.is_edit != (strcmp(words, "image edit") == 0);
        session.is_edit = strcmp(words, "image edit") == 0;
    } else if (strcmp(words, "goal") == 0) {
        list.waits = true;
        list.waits_since = session.tick;
    } else if (strcmp(words, "end") == 0) {
        session.is_over = true;
    } else if (!world_do(words)) {
        fprintf(stderr, "simtime_session: not an action: %s\n", words);
        exit(EXIT_USAGE);
    }
}

/* Carries out the actions that are due. */
static void take_due(void)
{
    const bool came = session.frame_tick > list.waits_since || session.tick - list.waits_since >= GOAL_COMES;
    if (list.waits && came) {
        list.waits = false;
        list.late += session.tick - list.waits_since;
    }
    while (list.next < list.count && list.action[list.next].tick + list.late <= session.tick && !list.waits &&
           !session.is_over) {
        take(list.action[list.next++].words);
    }
}

static simtime_callbacks_t callbacks;

static void tick(void)
{
    world_callbacks.tick();
    take_due();
    if (session.is_over || list.switch_image) {
        simtime_stop();
    }
}

/* ---- starts ---- */

static void start_once(const char *folder)
{
    char file[PATH_BYTES];
    const char *error;
    snprintf(file, sizeof file, "%s/libsimtime-%s.so", folder, session.is_edit ? "edit" : "play");
    list.switch_image = false;
    session.boot_tick = session.tick;
    world_power(true);
    world_forget_line();
    marks_boot();
    rules_boot();
    const simtime_end_t end = simtime_run(file, &error);
    if (error != NULL) {
        fprintf(stderr, "simtime_session: %s: %s\n", file, error);
        exit(EXIT_USAGE);
    }
    if (end == SIMTIME_HUNG) {
        session_fail("answers", "the watchdog was not kicked for a second");
    }
    if (end != SIMTIME_ENDED) {
        world_power(false);   /* a restart leaves the power of the servos on */
    }
    if (++session.boots > STARTS_MAX) {
        session_fail("answers", "the program starts again and again");
    }
}

int main(int argc, char **argv)
{
    session.shows = argc == 3 && strcmp(argv[2], "--show") == 0;
    if (argc != (session.shows ? 3 : 2)) {
        fprintf(stderr, "usage: simtime_session FOLDER [--show] < actions\n");
        return EXIT_USAGE;
    }
    signal(SIGVTALRM, on_signal);
    signal(SIGABRT, on_signal);
    signal(SIGSEGV, on_signal);
    signal(SIGFPE, on_signal);
    signal(SIGBUS, on_signal);
    signal(SIGILL, on_signal);
    /* CPU time of this process: a busy computer is no fault. */
    setitimer(ITIMER_VIRTUAL, &(struct itimerval){.it_value = {.tv_sec = HANG_S}}, NULL);
    world_init();
    callbacks = world_callbacks;
    callbacks.tick = tick;
    simtime_init(&callbacks);
    read_list();
    take_due();
    while (!session.is_over) {
        start_once(argv[1]);
    }
    rules_end();
    print_figures();
    world_free();
    return 0;
}
