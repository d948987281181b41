/* SPDX-License-Identifier: MIT */
#include "console.h"
#include "clock.h"
#include "irq.h"

#include <avr/io.h>

/* Whole-register values instead of read-modify-write: main loop and ISRs both set them. */
#define MODE_U2X (1u << U2X1)
#define FRAME_8N1 ((1u << UCSZ11) | (1u << UCSZ10))
#define QUIET ((1u << RXEN1) | (1u << TXEN1) | (1u << RXCIE1))
#define TALKING (QUIET | (1u << UDRIE1))
#define XOFF_AGAIN_BYTES 32u

static uint8_t rx_storage[CONSOLE_RX_BYTES], tx_storage[CONSOLE_TX_BYTES];
static ring_t rx = { rx_storage, CONSOLE_RX_BYTES - 1u, 0, 0 };   /* in: ISR (and the loader's page-write); out: main */
static ring_t tx = { tx_storage, CONSOLE_TX_BYTES - 1u, 0, 0 };   /* in: main; out: ISR */
static volatile uint8_t flow_byte;      /* XON or XOFF to go out first; 0: none */
static volatile uint8_t received, sent; /* ISR */
static volatile uint8_t lost;           /* the loader's page-write */
static volatile bool xoff_is_out;       /* under flow control: the PC was told to stop */
static volatile uint8_t since_xoff;     /* bytes that came all the same, modulo XOFF_AGAIN_BYTES */
static volatile bool has_sent;          /* TXC means something */
static bool flow, held;
static console_counts_t counters;       /* ISR */

void console_init(void)
{
    UCSR1B = 0;   /* receiver off: empties its buffer */
    ring_init(&rx, rx_storage, CONSOLE_RX_BYTES);
    ring_init(&tx, tx_storage, CONSOLE_TX_BYTES);
    flow_byte = 0;
    received = 0;
    sent = 0;
    lost = 0;
    xoff_is_out = false;
    since_xoff = 0;
    has_sent = false;
    flow = false;
    held = false;
    counters = (console_counts_t){ 0, 0, 0 };
    UCSR1A = MODE_U2X | (1u << TXC1);
    UBRR1H = 0;
    UBRR1L = CONSOLE_RATE_57600;
    UCSR1C = FRAME_8N1;
    UCSR1B = QUIET;
}

void console_set_rate(uint8_t divisor)
{
    console_flush();
    UBRR1H = 0;
    UBRR1L = divisor;
}

static void send_flow(uint8_t byte)
{
    flow_byte = byte;
    UCSR1B = TALKING;
}

bool console_get(uint8_t *byte)
{
    if (!ring_get(&rx, byte)) {
        return false;
    }
    if (xoff_is_out && !held && ring_count(&rx) <= CONSOLE_XON_COUNT) {
        xoff_is_out = false;
        send_flow(CONSOLE_XON);
    }
    return true;
}

uint8_t console_waiting(void)
{
    return ring_count(&rx);
}

void console_drop_input(void)
{
    uint8_t byte;
    while (console_get(&byte)) {
    }
}

bool console_put(uint8_t byte)
{
    if (!ring_put(&tx, byte)) {
        return false;
    }
    UCSR1B = TALKING;
    return true;
}

uint8_t console_room(void)
{
    return ring_room(&tx);
}

void console_write(const void *bytes, uint16_t count)
{
    const uint8_t *byte = bytes;
    while (count > 0) {
        if (console_put(*byte)) {
            byte++;
            count--;
        }
    }
}

void console_flush(void)
{
    while (flow_byte != 0 || ring_count(&tx) > 0) {
    }
    while (has_sent && !(UCSR1A & (1u << TXC1))) {
    }
}

void console_set_flow(bool on)
{
    flow = on;
    held = false;
    if (!on && xoff_is_out) {
        xoff_is_out = false;
        send_flow(CONSOLE_XON);
    }
}

void console_hold(void)
{
    if (!flow) {
        return;
    }
    held = true;
    xoff_is_out = true;
    since_xoff = 0;
    send_flow(CONSOLE_XOFF);
    while (flow_byte != 0) {
    }
    clock_wait_us(350);   /* it stands behind at most one character in the UART */
}

void console_resume(void)
{
    held = false;
    if (xoff_is_out && ring_count(&rx) <= CONSOLE_XON_COUNT) {
        xoff_is_out = false;
        send_flow(CONSOLE_XON);
    }
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
    irq_state_t state = irq_save();
    *counts = counters;
    irq_restore(state);
    counts->ring_full = (uint16_t)(counts->ring_full + lost);
}

static inline void bump(uint16_t *count)
{
    if (*count != 0xFFFFu) {
        (*count)++;
    }
}

/* Under flow control: the PC is told to stop when the ring runs low, and again for every 32 bytes it still sends. */
static inline void watch_room(void)
{
    if (!flow || ring_room(&rx) >= CONSOLE_XOFF_ROOM) {
        return;
    }
    if (!xoff_is_out || ++since_xoff == XOFF_AGAIN_BYTES) {
        xoff_is_out = true;
        since_xoff = 0;
        send_flow(CONSOLE_XOFF);
    }
}

/* Budget 150 cycles of the 2,800 between two characters at 57,600. */
ISR(USART1_RX_vect)
{
    uint8_t status = UCSR1A;   /* before UDR1: it speaks of the byte there */
    uint8_t byte = UDR1;
    if (status & (1u << DOR1)) {
        bump(&counters.overruns);
    }
    if (status & (1u << FE1)) {
        bump(&counters.framing);
        return;
    }
    received++;
    if (!ring_put(&rx, byte)) {
        bump(&counters.ring_full);
    }
    watch_room();
}

/* Budget 100 cycles. */
ISR(USART1_UDRE_vect)
{
    uint8_t byte = flow_byte;
    if (byte != 0) {
        flow_byte = 0;
    } else if (!ring_get(&tx, &byte)) {
        UCSR1B = QUIET;
        return;
    }
    UDR1 = byte;
    UCSR1A = MODE_U2X | (1u << TXC1);   /* this byte has not left: transmit complete starts anew */
    has_sent = true;
    sent++;
}
