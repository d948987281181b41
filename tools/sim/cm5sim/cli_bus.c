/* SPDX-License-Identifier: MIT */
#include "cli_bus.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli_files.h"
#include "cli_pty.h"
#include "cli_trace.h"
#include "servo_protocol.h"

/* A USB adapter sends a packet in one piece. The kernel may hand it to us in several, so a packet that has begun is
 * given this long to become whole before it goes on the wire as it is. */
#define GATHER_NS 3000000
#define LOOK_MS 200 /* asleep at most so long: signals, --time */
#define GATHERED_MAX 4096
#define TICK_CYCLES 125000u

typedef struct {
    const options_t *options;
    servo_bus_t *bus;
    pty_t pty;
    trace_t trace;
    bool tracing;
    struct timespec start;
    uint64_t line_free;   /* the PC's last byte has left */
    uint64_t next_tick;
    uint32_t rate_bps;
    uint8_t gathered[GATHERED_MAX];
    int gathered_count;
    uint64_t gathered_at; /* cycle of the newest of them */
    uint8_t answer[256];
    int answer_count;
} bus_run_t;

static uint64_t now_cycles(const bus_run_t *run)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const int64_t ns = (int64_t)(now.tv_sec - run->start.tv_sec) * 1000000000 + (now.tv_nsec - run->start.tv_nsec);
    return (uint64_t)ns * SERVO_CYCLES_PER_US / 1000;
}

static void send_answer(bus_run_t *run)
{
    if (run->answer_count > 0 && write(run->pty.master, run->answer, (size_t)run->answer_count) < 0) {
        /* nobody reads: lost, as on a cable */
    }
    run->answer_count = 0;
}

/* A byte of a servo. It answers at the rate it was asked at; a collision leaves a byte that no checksum fits. */
static void heard(void *context, uint64_t now, uint8_t byte, uint32_t rate_bps, bool bad)
{
    bus_run_t *run = context;
    (void)now;
    (void)rate_bps;
    if (bad) {
        byte = (uint8_t)(byte ^ 0x80u);
    }
    run->answer[run->answer_count++] = byte;
    if (run->answer_count == (int)sizeof run->answer) {
        send_answer(run);
    }
}

/* Do the gathered bytes end with a whole packet? */
static bool is_whole(const bus_run_t *run)
{
    servo_parser_t parser = {.count = 0};
    bool whole = false;
    for (int i = 0; i < run->gathered_count; i++) {
        whole = servo_parser_byte(&parser, NULL, 0, 0, run->gathered[i]);
        if (whole) {
            servo_parser_clear(&parser);
        }
    }
    return whole;
}

/* Writes the rows of all ticks up to this cycle. Servos that have been brought up to a later moment do not go back: this
 * comes before whatever happens on the wire at that cycle. */
static void trace_up_to(bus_run_t *run, uint64_t now)
{
    for (; run->tracing && run->next_tick <= now; run->next_tick += TICK_CYCLES) {
        servo_bus_advance(run->bus, run->next_tick);
        trace_row(&run->trace, run->next_tick / TICK_CYCLES, run->next_tick);
    }
}

/* Puts the gathered bytes on the wire, back to back. Servo time may run ahead of the clock by the packet's length;
 * it waits for the clock afterwards. */
static void put_on_wire(bus_run_t *run, uint64_t now)
{
    const uint64_t byte_cycles = 160000000u / run->rate_bps;
    uint64_t at = now > run->line_free ? now : run->line_free;
    for (int i = 0; i < run->gathered_count; i++) {
        at += byte_cycles;
        trace_up_to(run, at);
        servo_bus_host_byte(run->bus, at, run->gathered[i], run->rate_bps);
    }
    run->line_free = at;
    run->gathered_count = 0;
}

static void take_bytes(bus_run_t *run)
{
    const ssize_t count = read(run->pty.master, run->gathered + run->gathered_count,
                               (size_t)(GATHERED_MAX - run->gathered_count));
    if (count > 0) {
        run->gathered_count += (int)count;
        run->gathered_at = now_cycles(run);
        const uint32_t rate = pty_rate(&run->pty);
        run->rate_bps = rate >= 1200 && rate <= 4000000 ? rate : 1000000;
    }
}

/* How long nothing will happen by itself, for ppoll. */
static int wait_ms(const bus_run_t *run, uint64_t now)
{
    uint64_t wake = now + LOOK_MS * SERVO_CYCLES_PER_MS;
    const uint64_t event = servo_bus_next_cycles(run->bus);
    wake = event < wake ? event : wake;
    wake = run->gathered_count > 0 && now + SERVO_CYCLES_PER_MS < wake ? now + SERVO_CYCLES_PER_MS : wake;
    wake = run->tracing && run->next_tick < wake ? run->next_tick : wake;
    wake = run->options->time_cycles < wake ? run->options->time_cycles : wake;
    return wake <= now ? 0 : (int)((wake - now + SERVO_CYCLES_PER_MS - 1) / SERVO_CYCLES_PER_MS);
}

static void step(bus_run_t *run)
{
    struct pollfd entry = {.fd = run->pty.master, .events = POLLIN};
    if (poll(&entry, 1, wait_ms(run, now_cycles(run))) > 0) {
        take_bytes(run);
    }
    const uint64_t now = now_cycles(run);
    const uint64_t gather = (uint64_t)GATHER_NS * SERVO_CYCLES_PER_US / 1000;
    if (run->gathered_count > 0
        && (is_whole(run) || now - run->gathered_at > gather || run->gathered_count == GATHERED_MAX)) {
        put_on_wire(run, now);
    }
    if (now > run->line_free) {
        trace_up_to(run, now);
        servo_bus_advance(run->bus, now);
    }
    send_answer(run);
}

static const char *open_all(bus_run_t *run)
{
    const options_t *options = run->options;
    const char *error = files_plug_in_servos(run->bus, options, 0);
    if (error == NULL && options->trace) {
        run->tracing = trace_open(&run->trace, options->trace, run->bus);
        error = run->tracing ? NULL : strerror(errno);
    }
    return error ? error : pty_open(&run->pty, options->bus_link, 1000000);
}

int bus_main(const options_t *options, const volatile int *interrupted)
{
    bus_run_t run = {.options = options, .bus = servo_bus_new()};
    const char *error = run.bus ? open_all(&run) : "no memory";
    if (error) {
        fprintf(stderr, "cm5sim: %s\n", error);
        return EXIT_FILE;
    }
    run.bus->on_byte = heard;
    run.bus->on_byte_context = &run;
    fprintf(stderr, "cm5sim: servo bus: %s\n", run.pty.path);
    clock_gettime(CLOCK_MONOTONIC, &run.start);
    while (!*interrupted && now_cycles(&run) < options->time_cycles) {
        step(&run);
    }
    trace_up_to(&run, now_cycles(&run));
    if (run.tracing && !trace_close(&run.trace)) {
        error = "the trace could not be written";
    }
    error = options->servo_eeprom && error == NULL ? files_save_servos(run.bus, options->servo_eeprom) : error;
    if (error) {
        fprintf(stderr, "cm5sim: %s\n", error);
    }
    pty_close(&run.pty);
    servo_bus_free(run.bus);
    return error ? EXIT_FILE : EXIT_GOOD;
}
