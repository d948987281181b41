/* SPDX-License-Identifier: MIT
 * toss.c - the bridge between PC and servos. Forwards packets from the console to the bus, and all bytes from the bus to the
 * console, unchanged. Silence or a lost byte drops an incomplete packet, so that it swallows no bytes of the next.
 * Three ESC end the bridge, the first after a silence: the rest of a damaged packet may have three in a row. */
#include "monitor.h"

#include <string.h>
#include "bus.h"
#include "console.h"
#include "ring.h"
#include "system.h"
#include "tick.h"

enum { ESC = 0x1B, ESCAPES = 3, HEADER_BYTES = 4, LENGTH_AT = 3, LENGTH_MIN = 2 };
enum { SILENCE_TICKS = 3 };   /* 16 to 23 ms: longer than a USB adapter delays bytes, shorter than a PC awaits an answer */

typedef struct {
    uint8_t count;     /* bytes of the PC's packet so far */
    uint8_t escapes;   /* consecutive ESCs, the first after a silence */
    bool was_silent;   /* silence before the next byte */
    uint16_t since;    /* the tick of the last byte */
    uint8_t packet[BUS_PACKET_BYTES];
} toss_t;

/* Takes a byte from the PC. true: the packet is complete. */
static bool collect(toss_t *toss, uint8_t byte)
{
    if (toss->count < 2 && byte != 0xFF) {
        toss->count = 0;
        toss->escapes = byte == ESC && (toss->was_silent || toss->escapes > 0) ? toss->escapes + 1u : 0;
        return false;
    }
    if (toss->count == 2 && byte == 0xFF) {
        return false;
    }
    toss->escapes = 0;
    toss->packet[toss->count++] = byte;
    bool is_whole = toss->count > HEADER_BYTES && toss->count == toss->packet[LENGTH_AT] + HEADER_BYTES;
    /* A length that no packet has: the bytes were not a packet. */
    if (!is_whole && (toss->count >= BUS_PACKET_BYTES || (toss->count == HEADER_BYTES && byte < LENGTH_MIN))) {
        toss->count = 0;
    }
    return is_whole;
}

/* Takes the PC's next byte. true: a packet is complete. */
static bool listen(toss_t *toss)
{
    uint8_t byte;
    if ((uint16_t)(tick_now16() - toss->since) >= SILENCE_TICKS) {
        toss->count = 0;
        toss->was_silent = true;
    }
    if (!console_get(&byte)) {
        return false;
    }
    toss->since = tick_now16();
    if (console_lost() != 0) {
        toss->count = 0;
        toss->was_silent = false;
    }
    const bool is_whole = collect(toss, byte);
    toss->was_silent = false;
    return is_whole;
}

static void pass_on(ring_t *heard)
{
    uint8_t byte;
    while (ring_get(heard, &byte)) {
        console_write(&byte, 1);
    }
}

static void send(toss_t *toss, ring_t *heard)
{
    while (bus_is_busy()) {
        (void)bus_poll(NULL);
        pass_on(heard);
    }
    memcpy(bus_packet(), toss->packet, toss->count);
    (void)bus_submit(toss->count, BUS_NO_ANSWER, 1);
    toss->count = 0;
}

void toss_run(uint8_t buffer[TOSS_BUFFER_BYTES])
{
    toss_t toss = { 0, 0, true, tick_now16(), { 0 } };
    ring_t heard;
    ring_init(&heard, buffer, TOSS_BUFFER_BYTES);
    bus_set_tap(&heard);
    while (toss.escapes < ESCAPES) {
        system_kick();
        if (listen(&toss)) {
            send(&toss, &heard);
        }
        (void)bus_poll(NULL);
        pass_on(&heard);
    }
    bus_set_tap(NULL);
}
