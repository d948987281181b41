/* SPDX-License-Identifier: MIT
 * console.c - console.h over the machine's console. It has no rate. Flow control is the machine's: bytes without room stay
 * in the machine, so nothing is lost and XOFF is never sent. An image may have less room than rx, like Play. Therefore rx
 * holds at most as many bytes as still arrive after an XOFF, and takes none until the XON. */
#include "console.h"

#include <string.h>
#include "host.h"
#include "machine.h"

#define AT_ONCE 16u

static uint8_t rx_storage[CONSOLE_RX_BYTES];
static ring_t rx;
static uint8_t tx[CONSOLE_TX_BYTES];
static uint8_t tx_count;
static uint8_t received, sent;
static bool has_rested;      /* since the last byte of input */
static bool output_waited;   /* since the last rest */
static uint8_t xoffs;   /* calls of console_xoff without a matching console_xon */
static volatile uint8_t lost;

void console_init(void)
{
    ring_init(&rx, rx_storage, CONSOLE_RX_BYTES);
    tx_count = 0;
    xoffs = 0;
    received = 0;
    sent = 0;
    has_rested = false;
    output_waited = false;
}

void console_set_rate(uint8_t divisor)
{
    (void)divisor;
}

void host_fetch_console(void)
{
    uint8_t bytes[CONSOLE_RX_BYTES];
    const uint8_t here = ring_count(&rx), most = xoffs > 0 ? 0 : AT_ONCE;
    const uint16_t count = machine_console_read(bytes, here < most ? (uint16_t)(most - here) : 0);
    for (uint16_t i = 0; i < count; i++) {
        received++;
        (void)ring_put(&rx, bytes[i]);
    }
    has_rested &= count == 0;
    const uint8_t gone = (uint8_t)machine_console_write(tx, tx_count);
    tx_count = (uint8_t)(tx_count - gone);
    sent = (uint8_t)(sent + gone);
    memmove(tx, tx + gone, tx_count);
    output_waited |= tx_count > 0;
}

/* A program also rests while its output waits, but then it is in the middle of a line. */
void host_console_rest(void)
{
    has_rested |= ring_count(&rx) == 0 && tx_count == 0 && !output_waited;
    output_waited = false;
}

bool host_console_has_rested(void)
{
    return has_rested;
}

/* ---- input ---- */

bool console_get(uint8_t *byte)
{
    return ring_get(&rx, byte);
}

bool console_peek(uint8_t *byte)
{
    return ring_peek(&rx, byte);
}

uint8_t console_lost(void)
{
    return 0;   /* bytes without room wait in the machine */
}

uint8_t console_waiting(void)
{
    return ring_count(&rx);
}

void console_drop_input(void)
{
    ring_clear(&rx);
}

/* ---- output ---- */

bool console_put(uint8_t byte)
{
    if (tx_count == sizeof tx) {
        host_fetch();
    }
    if (tx_count == sizeof tx) {
        return false;
    }
    tx[tx_count++] = byte;
    return true;
}

uint8_t console_room(void)
{
    return (uint8_t)(sizeof tx - tx_count);
}

void console_write(const void *bytes, uint16_t count)
{
    const uint8_t *byte = bytes;
    while (count > 0) {
        if (console_put(*byte)) {
            byte++;
            count--;
        } else {
            host_wait(host_next_tick());
        }
    }
}

void console_flush(void)
{
    host_fetch();
    while (tx_count > 0) {
        host_wait(host_next_tick());
    }
}

/* ---- flow control: within the program ---- */

void console_set_flow(bool on)
{
    (void)on;
    xoffs = 0;
}

void console_xoff(void)
{
    xoffs++;
}

void console_xon(void)
{
    xoffs = (uint8_t)(xoffs > 0 ? xoffs - 1 : 0);
}

/* ---- counts ---- */

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
    memset(counts, 0, sizeof *counts);
}
