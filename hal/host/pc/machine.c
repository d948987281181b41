/* SPDX-License-Identifier: MIT
 * machine.c - the computer's clock, the program's only sleep, signals, and the end. */
#include "machine.h"

#include <errno.h>
#include <sched.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include "host.h"
#include "pc.h"

enum { EXIT_STILL_ON = 6, EXIT_HUNG = 70, EXIT_ASKED_TWICE = 130 };
#define MS 2000u
#define ONE_WISH_MS 100u   /* `timeout` signals twice, a shell a whole group; no person presses Ctrl-C again so fast */
#define WATCH_SECONDS 1

static volatile sig_atomic_t asked_to_end;
static volatile sig_atomic_t asked_ms;   /* when; wraps */
static volatile sig_atomic_t seen_alive = 1;
static volatile sig_atomic_t silent_seconds;

/* ---- time ---- */

/* Counts the time in which the computer sleeps, too: a play must not go on when it wakes up. */
uint64_t machine_now(void)
{
    static time_t first;
    struct timespec now;
    clock_gettime(CLOCK_BOOTTIME, &now);
    if (first == 0) {
        first = now.tv_sec - 1;
    }
    return (uint64_t)(now.tv_sec - first) * 2000000u + (uint64_t)now.tv_nsec / 500u;
}

void machine_wait(uint64_t until)
{
    struct pollfd entries[1 + TERMINAL_FDS];
    port_poll(&entries[0]);
    const int count = 1 + terminal_poll(entries + 1);
    const uint64_t now = machine_now();
    const uint64_t left = until > now ? until - now : 0;
    const struct timespec wait = {.tv_sec = (time_t)(left / 2000000u), .tv_nsec = (long)(left % 2000000u) * 500};
    (void)ppoll(entries, (nfds_t)count, &wait, NULL);
}

/* ---- messages ---- */

void machine_tell(const char *sentence)
{
    fprintf(stderr, "\r%s: %s\r\n", pc_options.name, sentence);
}

void pc_fail(int code, const char *format, ...)
{
    va_list arguments;
    terminal_restore();
    fprintf(stderr, "%s: ", pc_options.name);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputs("\n", stderr);
    exit(code);
}

/* ---- signals ---- */

static void say_and_leave(const char *sentence, int code)
{
    terminal_restore();
    const ssize_t said = write(STDERR_FILENO, sentence, strlen(sentence));
    (void)said;
    _exit(code);
}

void machine_ask_to_end(void)
{
    const uint32_t now_ms = (uint32_t)(machine_now() / MS);
    if (!asked_to_end) {
        asked_ms = (sig_atomic_t)now_ms;
        asked_to_end = 1;
    } else if (now_ms - (uint32_t)asked_ms > ONE_WISH_MS) {
        say_and_leave("\r\nEnded at once, as you asked twice. The servos hold their last goals.\r\n", EXIT_ASKED_TWICE);
    }
}

void machine_lose_terminal(void)
{
    if (!asked_to_end) {
        machine_ask_to_end();
    }
}

static void on_end(int number)
{
    if (number == SIGHUP) {
        machine_lose_terminal();
    } else {
        machine_ask_to_end();
    }
}

/* Runs once per second. A computer that slept wakes up with one such signal, so only two in a row count. */
static void on_alarm(int number)
{
    (void)number;
    silent_seconds = seen_alive ? 0 : silent_seconds + 1;
    seen_alive = 0;
    if (silent_seconds >= 2) {
        say_and_leave("\r\nThe program hung for a second and was ended. The servos hold their last goals.\r\n", EXIT_HUNG);
    }
}

/* The shell has used the terminal meanwhile. */
static void on_continue(int number)
{
    (void)number;
    if (tcgetpgrp(STDIN_FILENO) == getpgrp()) {
        terminal_take();
    }
}

static void on_crash(int number)
{
    terminal_restore();
    signal(number, SIG_DFL);
    raise(number);
}

static void handle(int number, void (*handler)(int))
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = handler;
    sigaction(number, &action, NULL);
}

static void handle_signals(void)
{
    static const int ends[] = {SIGINT, SIGTERM, SIGHUP}, crashes[] = {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        handle(ends[i], on_end);
    }
    for (size_t i = 0; i < sizeof crashes / sizeof crashes[0]; i++) {
        handle(crashes[i], on_crash);
    }
    handle(SIGCONT, on_continue);
    handle(SIGPIPE, SIG_IGN);
    handle(SIGALRM, on_alarm);
    const struct itimerval beat = {.it_interval = {.tv_sec = WATCH_SECONDS}, .it_value = {.tv_sec = WATCH_SECONDS}};
    setitimer(ITIMER_REAL, &beat, NULL);
}

/* ---- life ---- */

void machine_watch(void)
{
    seen_alive = 1;
}

bool machine_is_asked_to_end(void)
{
    return asked_to_end || (terminal_has_ended() && host_console_has_rested());   /* first come the lines of the pipe */
}

void machine_end(void)
{
    bool is_off = false;
    if (pc_options.off) {
        (void)port_drain();
        host_torque_off();
        is_off = port_drain();
    }
    host_settle();
    terminal_drain();
    terminal_restore();
    if (is_off) {
        machine_tell("ended. The torque of all servos is off");
    } else if (pc_options.off) {
        machine_tell(machine_bus_is_there() ? "ended. The adapter takes no packets: the servos keep their torque"
                                            : "ended. The adapter is gone: the servos keep their torque");
        exit(EXIT_STILL_ON);
    } else if (host_has_held()) {
        machine_tell("ended. Servos that held their pose go on holding it. To make them limp: --off, or m512 torque off");
    }
    exit(EXIT_SUCCESS);
}

/* Runs ahead of other programs, if the user has the permission: a tick is 0.1 ms of work that should not wait. */
static void ask_for_priority(void)
{
    const struct sched_param lowest = {.sched_priority = 1};
    (void)sched_setscheduler(0, SCHED_RR, &lowest);
}

void pc_open(void)
{
    ask_for_priority();
    files_open();
    port_open();
    terminal_open();
    handle_signals();
}
