/* SPDX-License-Identifier: MIT
 * bus.c - bus.h through an adapter on a serial port. The engine is the chip's, bus_core.c. Differences:
 *
 * - A packet is written in one piece and leaves by itself; the engine passes SENDING and TURNING within one call.
 * - The adapter and the driver deliver an answer up to 50 ms late. The time-out is twice the longest measured answer time
 *   plus a margin. While an answer is outstanding, packets without an answer may leave (bus_is_free), because the line
 *   itself is already quiet.
 * - The port may disappear. */
#include "bus.h"

#include <string.h>
#include "bus_core.h"
#include "bus_port.h"
#include "clock.h"
#include "echo.h"
#include "host.h"
#include "machine.h"

#define MS CLOCK_PER_MS
#define ANSWER_ON_THE_LINE (3u * MS)   /* the servo's return delay, its answer, and an adapter that takes 2 ms to send */
#define PATIENCE_EXTRA (8u * MS)       /* beyond twice the longest answer time */
#define PATIENCE_ONCE (100u * MS)      /* added for a packet with one try: the health poll, for which nobody waits */
#define ANSWER_MAX (100u * MS)         /* longer answer times are those of a computer that slept */
#define SLEPT (10u * 1000u * MS)       /* no answer is awaited for so long, except by a computer that slept */
#define HELD_MAX (2u * MS)             /* the rest of an echo arrives sooner */
#define MOVING_HALF_US (250u * MS)
#define PROBES 3u

static bus_core_t core;
static echo_t echo;
static struct {
    uint8_t rate;
    bool is_there, lost;
    bool has_held;           /* goals or torque were sent: servos may hold their pose */
    bool once;               /* the current packet has only one try */
    bool unread;             /* an answer was requested, and bus_poll() has not returned its result yet */
    bool echoes;             /* the adapter echoes sent packets */
    uint64_t line_free;      /* when the last bit of our last packet leaves the adapter */
    uint64_t asked_at;       /* the same for the packet whose answer is awaited, or was missed */
    uint64_t heard_at;       /* when the last byte arrived */
    uint64_t goals_at;       /* when goals were last sent; 0: never */
    uint32_t longest;        /* answer time; 0: none yet */
} port;

/* ---- receiving ---- */

static void note_answer_time(void)
{
    const uint64_t now = machine_now();
    const uint64_t taken = now > port.asked_at ? now - port.asked_at : 1u;
    if (taken > port.longest) {
        port.longest = taken > ANSWER_MAX ? ANSWER_MAX : (uint32_t)taken;
    }
}

static void take_bytes(const uint8_t *bytes, uint16_t count)
{
    if (count > 0 && core.state == BUS_IDLE && core.result == BUS_ERR_TIMEOUT && core.answer_params != BUS_NO_ANSWER) {
        note_answer_time();   /* an answer after the time-out */
    }
    for (uint16_t i = 0; i < count; i++) {
        bus_core_on_byte(&core, bytes[i], 0);
    }
}

static void watch_port(void)
{
    const bool is_there = machine_bus_is_there();
    if (port.is_there && !is_there) {
        port.lost = true;
    }
    port.is_there = is_there;
}

void host_fetch_bus(void)
{
    uint8_t bytes[256], out[ECHO_HELD_BYTES];
    uint16_t count;
    watch_port();
    while ((count = machine_bus_read(bytes, sizeof bytes)) > 0) {
        port.heard_at = machine_now();
        if (!port.echoes) {
            take_bytes(bytes, count);
            continue;
        }
        for (uint16_t i = 0; i < count; i++) {
            take_bytes(out, echo_byte(&echo, bytes[i], out));
        }
    }
    if (echo.held_count > 0 && machine_now() - port.heard_at > HELD_MAX) {
        take_bytes(out, echo_quiet(&echo, out));
    }
}

/* ---- sending ---- */

static void send(const uint8_t *packet, uint8_t size)
{
    const uint64_t now = machine_now();
    port.line_free = (now > port.line_free ? now : port.line_free) + (uint64_t)size * core.byte_half_us;
    if (packet[4] == DXL_SYNC_WRITE && packet[5] == DXL_AT_GOAL) {
        port.goals_at = now;
        port.has_held = true;
    } else if (packet[4] == DXL_WRITE && packet[5] == DXL_AT_TORQUE_ENABLE && packet[6] != 0) {
        port.has_held = true;
    }
    if (port.echoes) {
        echo_sent(&echo, packet, size);
    }
    if (port.is_there) {
        machine_bus_write(packet, size);
    }
}

void bus_port_send(uint8_t count)
{
    host_fetch_bus();   /* earlier bytes are not an answer to this */
    send(core.packet, count);
    port.asked_at = port.line_free;
    bus_core_on_last(&core);
    bus_core_on_sent(&core, (bus_time_t)port.line_free);
}

void bus_port_listen(void)
{
}

TARGET_BUS_TIME bus_port_margin_half_us(void)
{
    const uint32_t measured = 2u * port.longest + PATIENCE_EXTRA, least = machine_bus_least_patience();
    const uint32_t patience = port.longest == 0 ? machine_bus_first_patience() : measured > least ? measured : least;
    if (!port.is_there) {
        return 0;
    }
    if (core.heard_count > 0) {
        return least;   /* the answer has begun */
    }
    return port.once ? patience + PATIENCE_ONCE : patience;
}

/* ---- echo ---- */

/* Sends packets that no servo answers or obeys: SYNC WRITEs without a servo. */
static void find_echo(void)
{
    uint8_t probe[DXL_PACKET_OVERHEAD + 2u];
    const uint8_t params[2] = {DXL_AT_LED, 1};
    const uint8_t size = dxl_build(probe, DXL_BROADCAST, DXL_SYNC_WRITE, params, sizeof params);
    port.echoes = true;
    host_fetch_bus();
    echo_clear(&echo);
    for (uint8_t i = 0; i < PROBES; i++) {
        send(probe, size);
    }
    const uint64_t until = port.line_free + machine_bus_first_patience();
    while (echo.dropped == 0 && machine_now() < until && port.is_there) {
        machine_wait(until);
        host_fetch_bus();
    }
    port.echoes = echo.dropped > 0;
    echo.held_count = 0;
}

/* ---- bus.h ---- */

void bus_init(void)
{
    memset(&port, 0, sizeof port);
    bus_core_init(&core);
    echo_clear(&echo);
    bus_set_rate(BUS_RATE_1M);
    watch_port();
    find_echo();
}

void bus_set_rate(uint8_t divisor)
{
    (void)bus_wait(0);
    while (machine_now() < port.line_free) {
        machine_wait(port.line_free);
    }
    port.rate = divisor;
    bus_core_set_rate(&core, divisor);
    core.byte_half_us = (uint16_t)(20000000u / machine_bus_rate(divisor));
}

uint8_t bus_rate(void)
{
    return port.rate;
}

uint8_t *bus_packet(void)
{
    return core.packet;
}

/* Takes received bytes and polls the engine. */
static bus_status_t look(bus_answer_t *answer)
{
    const bool waited = core.state == BUS_LISTENING;
    host_fetch_bus();
    if (waited && machine_now() > port.asked_at + SLEPT) {
        port.asked_at = machine_now();   /* waits anew: the engine's 32 bits hold only 1,000 s */
        core.since = (bus_time_t)port.asked_at;
    }
    const bus_status_t status = bus_core_poll(&core, (bus_time_t)machine_now(), answer);
    if (waited && status == BUS_OK) {
        note_answer_time();
    }
    return status;
}

bool bus_is_busy(void)
{
    return core.state != BUS_IDLE && look(0) == BUS_PENDING;
}

/* Our own packets leave one after the other anyway, but at a slow rate they must not pile up. */
bool bus_is_free(void)
{
    const bool waits = bus_is_busy();
    const uint64_t now = machine_now();
    return now >= port.line_free && (!waits || (core.tries_left == 0 && now > port.asked_at + ANSWER_ON_THE_LINE));
}

/* A packet without an answer bypasses the engine while the engine awaits an answer or has one not yet returned. */
bus_status_t bus_submit(uint8_t size, uint8_t answer_params, uint8_t tries)
{
    if (answer_params == BUS_NO_ANSWER && port.unread && (core.state == BUS_IDLE || bus_is_free())) {
        core.counts.packets++;
        send(core.packet, size);
        return BUS_OK;
    }
    const bus_status_t status = bus_core_submit(&core, size, answer_params, tries);
    if (status == BUS_PENDING) {
        port.once = tries == 1u;
        port.unread = answer_params != BUS_NO_ANSWER;
    }
    return status;
}

bus_status_t bus_poll(bus_answer_t *answer)
{
    const bus_status_t status = look(answer);
    port.unread = port.unread && status == BUS_PENDING;
    return status;
}

/* A sent packet is news only once it has left the adapter; until then the program sleeps. */
bool bus_has_news(void)
{
    return bus_core_has_news(&core) && machine_now() >= port.line_free;
}

bus_status_t bus_wait(bus_answer_t *answer)
{
    bus_status_t status;
    while ((status = bus_poll(answer)) == BUS_PENDING) {
        host_wait(machine_now() + MS);
    }
    return status;
}

void bus_wait_free(void)
{
    while (!bus_is_free()) {
        host_wait(machine_now() + MS / 8u);
    }
}

bool bus_was_lost(void)
{
    const bool lost = port.lost;
    port.lost = false;
    return lost;
}

void bus_set_tap(ring_t *ring)
{
    core.tap = ring;
}

void bus_counts(bus_counts_t *counts)
{
    bus_core_counts(&core, counts);
}

/* ---- host.h ---- */

uint64_t host_line_free(void)
{
    return port.line_free;
}

bool host_is_moving(void)
{
    return port.goals_at != 0 && machine_now() - port.goals_at < MOVING_HALF_US;
}

bool host_has_held(void)
{
    return port.has_held;
}

void host_torque_off(void)
{
    uint8_t packet[DXL_PACKET_OVERHEAD + 2u];
    const uint8_t params[2] = {DXL_AT_TORQUE_ENABLE, 0};
    const uint8_t size = dxl_build(packet, DXL_BROADCAST, DXL_WRITE, params, sizeof params);
    bus_wait_free();
    send(packet, size);
    send(packet, size);
}
