/* SPDX-License-Identifier: MIT */
#include "fake_console.h"
#include "console.h"
#include "trap.h"

#include <string.h>

static uint8_t rx_storage[CONSOLE_RX_BYTES];
static ring_t rx;
static uint8_t room, received, sent;
static volatile uint8_t lost;
static bool flow;
static uint8_t xoffs;
static console_counts_t counters;
static uint8_t holes, hole_at, lost_here;   /* bytes lost in front of this place of rx */

void fake_console_reset(void)
{
    ring_init(&rx, rx_storage, CONSOLE_RX_BYTES);
    memset(&counters, 0, sizeof counters);
    room = CONSOLE_TX_BYTES;
    holes = 0;
    lost_here = 0;
    received = 0;
    sent = 0;
    lost = 0;
    flow = false;
    xoffs = 0;
}

void fake_console_type_bytes(const void *bytes, size_t count)
{
    const uint8_t *byte = bytes;
    for (; count > 0; count--) {
        received++;
        if (!ring_put(&rx, *byte++)) {
            counters.ring_full = (uint8_t)(counters.ring_full + (counters.ring_full < 0xFFu ? 1 : 0));
            fake_console_lose(1);
        }
    }
}

void fake_console_lose(uint8_t count)
{
    ASSERT(holes == 0 || hole_at == rx.head);   /* the tests need no second place */
    hole_at = rx.head;
    holes = (uint8_t)(holes > 0xFFu - count ? 0xFFu : holes + count);
}

void fake_console_type(const char *text)
{
    fake_console_type_bytes(text, strlen(text));
}

int fake_console_is_held(void)
{
    return xoffs != 0;
}

void console_init(void)
{
    fake_console_reset();
}

void console_set_rate(uint8_t divisor)
{
    (void)divisor;
}

bool console_get(uint8_t *byte)
{
    const uint8_t at = rx.tail;
    if (!ring_get(&rx, byte)) {
        return false;
    }
    lost_here = holes != 0 && at == hole_at ? holes : 0;
    holes = lost_here != 0 ? 0 : holes;
    return true;
}

bool console_peek(uint8_t *byte)
{
    return ring_peek(&rx, byte);
}

uint8_t console_lost(void)
{
    return lost_here;
}

uint8_t console_waiting(void)
{
    return ring_count(&rx);
}

void console_drop_input(void)
{
    ring_clear(&rx);
}

bool console_put(uint8_t byte)
{
    if (room == 0) {
        return false;
    }
    (void)byte;
    room--;
    sent++;
    return true;
}

uint8_t console_room(void)
{
    return room;
}

void console_write(const void *bytes, uint16_t count)
{
    (void)bytes;
    sent = (uint8_t)(sent + count);
}

void console_flush(void)
{
    room = CONSOLE_TX_BYTES;
}

void console_set_flow(bool on)
{
    flow = on;
    xoffs = 0;
}

void console_xoff(void)
{
    xoffs = (uint8_t)(xoffs + (flow ? 1 : 0));
}

void console_xon(void)
{
    xoffs = (uint8_t)(xoffs - (xoffs != 0 ? 1 : 0));
}

ring_t *console_rx_ring(void)
{
    return &rx;
}

volatile uint8_t *console_rx_lost(void)
{
    return &lost;
}

uint8_t console_received(void)
{
    return received;
}

uint8_t console_sent(void)
{
    return sent;
}

void console_counts(console_counts_t *counts)
{
    *counts = counters;
    counts->ring_full = (uint8_t)(counts->ring_full + lost);
}
