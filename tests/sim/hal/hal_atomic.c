/* SPDX-License-Identifier: MIT
 * hal_atomic.c - on each request of test_hal_atomic.py, does one thing that main loop and interrupts share. The test
 * writes a number into atomic_job and reads the atomic_ variables at atomic_done(). The code to interrupt is in a
 * separate function (try_...), in which the board model raises an interrupt at each instruction (board_debug.h). */
#include "board.h"
#include "bus_call.h"
#include "bus_core.h"
#include "clock.h"
#include "compiler.h"
#include "console.h"
#include "dxl_packet.h"
#include "eeprom.h"
#include "irq.h"
#include "system.h"
#include "tick.h"

#include <avr/io.h>
#include <stddef.h>

#define TRY NOINLINE __attribute__((noclone, used)) static void

enum { JOB_NONE, JOB_TICK, JOB_CLOCK, JOB_COUNTS, JOB_TAP, JOB_EEPROM, JOB_IDLE, JOB_GET, JOB_PUT, JOB_FLUSH, JOB_RETRY,
       JOB_FLOW_ON, JOB_HOLD, JOB_RESUME, JOB_SUBMIT, JOB_STARS, JOB_DRAIN,
       JOB_PACKET };

/* Read and written by the test. */
volatile uint8_t atomic_job;
volatile uint16_t atomic_strays_at;
volatile uint32_t atomic_tick;
volatile uint16_t atomic_tick16, atomic_before, atomic_clock, atomic_after;
volatile bool atomic_taken, atomic_flushed;
volatile uint8_t atomic_byte, atomic_got, atomic_status, atomic_params;
bus_counts_t atomic_counts;
struct { ring_t ring; uint8_t storage[16]; } atomic_taps[14];
#define OLD_TAP (&atomic_taps[0])
#define NEW_TAP (&atomic_taps[ARRAY_COUNT(atomic_taps) - 1u])

TRY try_tick_now(void)
{
    atomic_tick = tick_now();
}

TRY try_tick_now16(void)
{
    atomic_tick16 = tick_now16();
}

TRY try_tick_take(void)
{
    atomic_taken = tick_take();
}

TRY try_clock_now(void)
{
    atomic_clock = clock_now();
}

TRY try_bus_counts(void)
{
    bus_counts(&atomic_counts);
}

TRY try_bus_set_tap(void)
{
    bus_set_tap(&NEW_TAP->ring);
}

TRY try_eeprom_start(void)
{
    (void)eeprom_start(0x123, atomic_byte);
}

TRY try_board_idle(void)
{
    board_idle();
}

TRY try_console_get(void)
{
    uint8_t byte = 0;
    atomic_got = console_get(&byte);
    atomic_byte = byte;
}

TRY try_console_put(void)
{
    atomic_got = console_put(atomic_byte);
}

TRY try_console_flush(void)
{
    console_flush();
}

TRY try_console_hold(void)
{
    console_xoff();
}

TRY try_console_resume(void)
{
    console_xon();
}

TRY try_bus_poll(void)
{
    (void)bus_poll(0);
}

TRY try_bus_submit(void)
{
    (void)bus_submit(dxl_build(bus_packet(), 1, DXL_PING, 0, 0), 0, 1);
}

TRY try_bus_send(uint8_t size)
{
    (void)bus_submit(size, BUS_NO_ANSWER, 1);
}

/* PINGs a missing servo and returns while the last character leaves: transmit complete can come at any moment. */
static void begin_last_character(void)
{
    (void)bus_wait(0);
    (void)bus_submit(dxl_build(bus_packet(), 99, DXL_PING, 0, 0), 0, 1);
    const bus_core_t *core = (const bus_core_t *)(bus_packet() - offsetof(bus_core_t, packet));
    while (core->state != BUS_TURNING || !(UCSR0A & (1u << UDRE0))) {
    }
}

static void read_clock(void)
{
    begin_last_character();
    TCNT3 = atomic_before;
    try_clock_now();
    atomic_after = clock_now();
    (void)bus_wait(0);
}

static void change_tap(void)
{
    ring_init(&OLD_TAP->ring, OLD_TAP->storage, sizeof OLD_TAP->storage);
    ring_init(&NEW_TAP->ring, NEW_TAP->storage, sizeof NEW_TAP->storage);
    bus_set_tap(&OLD_TAP->ring);
    try_bus_set_tap();
    irq_barrier();
    bus_set_tap(0);
}

/* Starts just after a tick, so that the next one is far away. */
static void idle(void)
{
    while (!tick_take()) {
    }
    console_drop_input();
    (void)bus_wait(0);
    try_board_idle();
}

/* Servo 1 sends one bad answer: the poll that finds the line quiet sends the packet again. */
static void retry(void)
{
    bus_answer_t answer;
    (void)bus_submit(dxl_build(bus_packet(), 1, DXL_READ, (const uint8_t[]){ 3, 1 }, 2), 1, 2);
    clock_wait_us(1500);
    (void)bus_poll(0);
    clock_wait_us(300);
    try_bus_poll();
    atomic_status = (uint8_t)bus_wait(&answer);
    atomic_params = answer.params[0];
    bus_counts(&atomic_counts);
}

static void submit(void)
{
    try_bus_submit();
    atomic_status = (uint8_t)bus_wait(0);
    bus_counts(&atomic_counts);
}

/* Sends a broadcast packet of atomic_byte bytes with an instruction that no servo knows. */
static void packet(void)
{
    uint8_t *params = bus_packet() + DXL_PARAMS_AT, count = (uint8_t)(atomic_byte - DXL_PACKET_OVERHEAD);
    for (uint8_t i = 0; i < count; i++) {
        params[i] = (uint8_t)(i + 1u);
    }
    try_bus_send(dxl_build(bus_packet(), DXL_BROADCAST, 0x55, params, count));
    atomic_status = (uint8_t)bus_wait(0);
}

static void flush(void)
{
    console_write("***", 3);
    try_console_flush();
    atomic_flushed = (UCSR1A & (1u << UDRE1)) != 0 && (UCSR1A & (1u << TXC1)) != 0;
}

static void tick(void)
{
    try_tick_now();
    try_tick_now16();
    try_tick_take();
}

NOINLINE __attribute__((noclone, used)) static void atomic_done(void)
{
    irq_barrier();
    atomic_job = JOB_NONE;
}

static void obey(uint8_t job)
{
    switch (job) {
    case JOB_TICK: tick(); break;
    case JOB_CLOCK: read_clock(); break;
    case JOB_COUNTS: try_bus_counts(); break;
    case JOB_TAP: change_tap(); break;
    case JOB_EEPROM: try_eeprom_start(); eeprom_wait(); break;
    case JOB_IDLE: idle(); break;
    case JOB_GET: try_console_get(); break;
    case JOB_PUT: try_console_put(); break;
    case JOB_FLUSH: flush(); break;
    case JOB_RETRY: retry(); break;
    case JOB_FLOW_ON: console_set_flow(true); console_flush(); break;
    case JOB_HOLD: try_console_hold(); break;
    case JOB_RESUME: try_console_resume(); console_flush(); break;
    case JOB_SUBMIT: submit(); break;
    case JOB_STARS: console_write("***", 3); break;
    case JOB_PACKET: packet(); break;
    case JOB_DRAIN: console_drop_input(); break;
    default: break;
    }
}

int main(void)
{
    board_start();
    atomic_strays_at = offsetof(bus_core_t, strays);
    for (;;) {
        uint8_t job = atomic_job;
        system_kick();
        if (job != JOB_NONE) {
            obey(job);
            atomic_done();
        }
    }
}
