/* SPDX-License-Identifier: MIT
 * cm5sim - the simulated robot as a command. `cm5sim --help` and README.md say what it does; the files cli_*.c do
 * it; this one paces the run. */
#include <inttypes.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "board_debug.h"
#include "cli_bus.h"
#include "cli_leave.h"
#include "cli_script.h"
#include "cli_session.h"
#include "cm5sim.h"

#define SLICE_CYCLES (2u * BOARD_CYCLES_PER_MS)     /* real time: keys are looked at this often */
#define LINGER_CYCLES (1000u * BOARD_CYCLES_PER_MS) /* after the end of piped input, silence that ends the run */
#define LATE_NS 250000000                           /* this far behind, real time is given up and begun anew */

static volatile int interrupted;
static board_t *volatile running; /* may stand still for GDB: a signal gets it out of there */

typedef struct {
    bool real;
    struct timespec start;
    uint64_t start_cycles;
} pace_state_t;

/* Signals end a run between two slices. A thread of its own waits for them, because a system call that they interrupt
 * upsets simavr's GDB server (it then waits for a client for ever). */
static void *wait_for_signal(void *signals)
{
    int number;
    if (sigwait(signals, &number) == 0) {
        interrupted = number;
        if (running) {
            board_stop(running);
        }
    }
    return NULL;
}

static void catch_signals(void)
{
    static sigset_t signals;
    pthread_t thread;
    const struct sigaction ignore = {.sa_handler = SIG_IGN};
    (void)sigaction(SIGPIPE, &ignore, NULL);
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGHUP);
    (void)pthread_sigmask(SIG_BLOCK, &signals, NULL);
    if (pthread_create(&thread, NULL, wait_for_signal, &signals) != 0) {
        (void)pthread_sigmask(SIG_UNBLOCK, &signals, NULL); /* then a signal simply kills */
    }
}

static void pace_begin(pace_state_t *pace, uint64_t now)
{
    clock_gettime(CLOCK_MONOTONIC, &pace->start);
    pace->start_cycles = now;
}

/* Nanoseconds until the wall clock reaches the simulated moment; negative: late. */
static int64_t pace_left(const pace_state_t *pace, uint64_t now)
{
    struct timespec clock;
    clock_gettime(CLOCK_MONOTONIC, &clock);
    const int64_t passed =
        (int64_t)(clock.tv_sec - pace->start.tv_sec) * 1000000000 + (clock.tv_nsec - pace->start.tv_nsec);
    return (int64_t)((now - pace->start_cycles) * 125 / 2) - passed; /* 62.5 ns a cycle */
}

static void wait_for_clock(session_t *session, pace_state_t *pace)
{
    const uint64_t now = board_now(session->board);
    if (!pace->real) {
        console_wait(&session->console, 0);
        return;
    }
    int64_t left = pace_left(pace, now);
    if (left < -LATE_NS) {
        pace_begin(pace, now);
        left = 0;
    }
    do {
        console_wait(&session->console, left);
        left = pace_left(pace, now);
    } while (left > 0 && !interrupted && !session->done);
}

static void report_violation(session_t *session)
{
    const violation_t *violation = board_violation(session->board);
    session_leave_screen(session);
    session_complain(session, "violation %s at cycle %" PRIu64 " (%.3f ms), PC 0x%05" PRIX32 " in %s: %s",
                     violation_name(violation->kind), violation->cycle,
                     (double)violation->cycle / BOARD_CYCLES_PER_MS, violation->pc, violation->function,
                     violation->text);
    session_end(session, EXIT_VIOLATION);
}

/* Only piped input kept the run alive, and it is over: no person waits for real time any more. */
static bool is_alone(const session_t *session)
{
    const options_t *options = session->options;
    return session->console.stdin_ended && !options->use_pty && !options->use_tcp;
}

/* The robot has had time to answer the last of it. */
static bool is_answered(const session_t *session)
{
    return is_alone(session) && session->options->time_cycles == UINT64_MAX
        && board_console_waiting(session->board) == 0
        && board_now(session->board) - session->last_traffic > LINGER_CYCLES;
}

static uint64_t earlier(uint64_t a, uint64_t b)
{
    return a < b ? a : b;
}

/* --summary: what the run was like. */
static void summarize(const session_t *session, const struct timespec *begun)
{
    struct timespec ended, cpu;
    uart_counts_t bus, console;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    clock_gettime(CLOCK_MONOTONIC, &ended);
    const double real = (double)(ended.tv_sec - begun->tv_sec) + (double)(ended.tv_nsec - begun->tv_nsec) / 1e9;
    const uint64_t now = board_now(session->board);
    const double simulated = (double)now / (1000.0 * BOARD_CYCLES_PER_MS);
    board_uart_counts(session->board, 0, &bus);
    board_uart_counts(session->board, 1, &console);
    const double busy = (double)cpu.tv_sec + (double)cpu.tv_nsec / 1e9;
    session_complain(session, "simulated %.3f s in %.3f s, %.3f s of this PC's CPU: %.1f times real time on one core",
                     simulated, real, busy, simulated / busy);
    session_complain(session, "CPU busy %.1f %%, stack headroom %u bytes, %u resets",
                     now ? 100.0 * (double)board_busy_cycles(session->board) / (double)now : 0.0,
                     board_stack_headroom(session->board), board_resets(session->board));
    session_complain(session, "bus: %" PRIu64 " bytes out, %" PRIu64 " in, %" PRIu64 " overruns, %" PRIu64
                     " framing errors", bus.sent, bus.received, bus.overruns, bus.framing);
    session_complain(session, "console: %" PRIu64 " bytes out, %" PRIu64 " in, %" PRIu64 " overruns, %" PRIu64
                     " framing errors", console.sent, console.received, console.overruns, console.framing);
}

/* A signal, or --time is over. A script that has not come to its end has not passed. */
static void stop(session_t *session, const script_t *script)
{
    if (script && !session->done) {
        session_complain(session, "%s:%d: the run ended here, before the script", script->path,
                         script->commands[script->next].line);
        session_end(session, EXIT_EXPECTATION);
    }
    session_end(session, EXIT_GOOD);
}

static void run(session_t *session, script_t *script)
{
    const options_t *options = session->options;
    const bool fast_by_default = options->script != NULL && !options->use_pty && !options->use_tcp;
    pace_state_t pace = {.real = options->pace == PACE_REAL || (options->pace == PACE_AUTO && !fast_by_default)};
    uint64_t tick = 0, wake = 0;
    pace_begin(&pace, 0);
    while (!session->done) {
        uint64_t now = board_now(session->board);
        uint64_t until = earlier((now / BOARD_CYCLES_PER_TICK + 1) * BOARD_CYCLES_PER_TICK, options->time_cycles);
        until = earlier(until, session_hands(session));
        until = earlier(until, script ? wake : NEVER_CYCLES);
        until = pace.real ? earlier(until, now + SLICE_CYCLES) : until;
        if (until > now && board_run(session->board, until - now) == BOARD_STOP_VIOLATION) {
            report_violation(session);
        }
        now = board_now(session->board);
        if (session->tracing && now / BOARD_CYCLES_PER_TICK != tick) {
            tick = now / BOARD_CYCLES_PER_TICK;
            trace_row(&session->trace, tick, now);
        }
        console_flush(&session->console);
        if (session->overlay.kind == OVERLAY_NOTE && now >= session->overlay.until) {
            overlay_hide(&session->overlay, &session->console);
        }
        leave_show(session);
        wake = script && !session->done ? script_step(script, session) : NEVER_CYCLES;
        pace.real = pace.real && !(options->pace == PACE_AUTO && is_alone(session));
        wait_for_clock(session, &pace);
        session_follow_rate(session);
        if (interrupted || now >= options->time_cycles) {
            stop(session, script);
        } else if (script == NULL && (session->console.stdout_ended || is_answered(session))) {
            session_end(session, EXIT_GOOD);
        }
    }
}

/* --body: a script of Python loads MuJoCo and calls cm5sim_run() of the same program as a library. It is given the body
 * and whether it is shown, and behind them the command line as it was typed: options may be shortened, as argp allows. */
static int run_in_body(const options_t *options, int argc, char **argv)
{
    const char *python = getenv("M512_PYTHON"), *body = getenv("M512_BODY_SCRIPT"); /* set by the wheel's command */
    python = python ? python : CM5SIM_PYTHON;
    body = body ? body : CM5SIM_BODY_SCRIPT;
    char **more = calloc((size_t)argc + 4, sizeof *more);
    if (more) {
        more[0] = (char *)python;
        more[1] = (char *)body;
        more[2] = (char *)options->body;
        more[3] = (char *)(options->view ? "view" : "tell");
        memcpy(more + 4, argv + 1, (size_t)argc * sizeof *more); /* with the NULL behind the last */
        execvp(python, more);
    }
    fprintf(stderr, "cm5sim: --body needs %s with MuJoCo: tools/dev/setup demo test physics\n", python);
    free(more);
    return EXIT_FILE;
}

int cm5sim_run(int argc, char **argv, const servo_body_t *body)
{
    options_t options;
    session_t session;
    script_t script;
    options_parse(&options, argc, argv);
    if (options.body && body == NULL) {
        return run_in_body(&options, argc, argv);
    }
    options.hung_on = body;
    catch_signals();
    if (options.bus_pty) {
        return bus_main(&options, &interrupted);
    }
    if (options.script && !script_load(&script, options.script)) {
        script_free(&script);
        return EXIT_USAGE;
    }
    const int error = session_open(&session, &options);
    session.exit_code = error;
    if (error == EXIT_GOOD) {
        struct timespec begun;
        running = session.board;
        clock_gettime(CLOCK_MONOTONIC, &begun);
        run(&session, options.script ? &script : NULL);
        session_leave_screen(&session);
        if (options.summary) {
            summarize(&session, &begun);
        }
    }
    running = NULL;
    session_close(&session);
    if (options.script) {
        script_free(&script);
    }
    return session.exit_code;
}
