/* SPDX-License-Identifier: MIT */
#include "console.h"
#include "clock.h"
#include "compiler.h"
#include "irq.h"

#include <avr/io.h>
#include <string.h>

/* Whole-register values instead of read-modify-write: main loop and ISRs both set them. */
#define MODE_U2X (1u << U2X1)
#define FRAME_8N1 ((1u << UCSZ11) | (1u << UCSZ10))
#define QUIET ((1u << RXEN1) | (1u << TXEN1) | (1u << RXCIE1))
#define TALKING (QUIET | (1u << UDRIE1))
#define XOFF_AGAIN_BYTES 32u

static uint8_t rx_storage[CONSOLE_RX_BYTES], tx_storage[CONSOLE_TX_BYTES];

static struct {
    ring_t rx;                       /* in: ISR (and the loader's page-write); out: main */
    ring_t tx;                       /* in: main; out: ISR */
    volatile uint8_t flow_byte;      /* XON or XOFF to go out first; 0: none */
    volatile uint8_t received, sent; /* ISR */
    volatile uint8_t lost;           /* the loader's page-write */
    volatile bool xoff_is_out;       /* under flow control: the PC was told to stop */
    volatile uint8_t since_xoff;     /* bytes that came after it, modulo XOFF_AGAIN_BYTES */
    volatile bool has_sent;          /* a byte was sent, so TXC is valid */
    bool flow;
    uint8_t xoffs;                   /* calls of console_xoff without their console_xon */
    console_counts_t counts;         /* ISR */
} line;

void console_init(void)
{
    UCSR1B = 0;   /* receiver off: empties its buffer */
    memset(&line, 0, sizeof line);
    ring_init(&line.rx, rx_storage, CONSOLE_RX_BYTES);
    ring_init(&line.tx, tx_storage, CONSOLE_TX_BYTES);
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
    line.flow_byte = byte;
    UCSR1B = TALKING;
}

/* Lets the PC go on once nothing keeps it waiting. NOINLINE: it would be copied twice. */
static NOINLINE void end_xoff(void)
{
    if (line.xoff_is_out && line.xoffs == 0 && ring_count(&line.rx) <= CONSOLE_XON_COUNT) {
        line.xoff_is_out = false;
        send_flow(CONSOLE_XON);
    }
}

bool console_get(uint8_t *byte)
{
    if (!ring_get(&line.rx, byte)) {
        return false;
    }
    end_xoff();
    return true;
}

uint8_t console_waiting(void)
{
    return ring_count(&line.rx);
}

void console_drop_input(void)
{
    uint8_t byte;
    while (console_get(&byte)) {
    }
}

bool console_put(uint8_t byte)
{
    if (!ring_put(&line.tx, byte)) {
        return false;
    }
    UCSR1B = TALKING;
    return true;
}

uint8_t console_room(void)
{
    return ring_room(&line.tx);
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
    while (line.flow_byte != 0 || ring_count(&line.tx) > 0) {
    }
    while (line.has_sent && !(UCSR1A & (1u << TXC1))) {
    }
}

void console_set_flow(bool on)
{
    line.flow = on;
    line.xoffs = 0;
    if (on || line.xoff_is_out) {
        line.xoff_is_out = false;
        send_flow(CONSOLE_XON);
    }
}

void console_xoff(void)
{
    if (!line.flow) {
        return;
    }
    line.xoffs++;
    line.xoff_is_out = true;
    line.since_xoff = 0;
    send_flow(CONSOLE_XOFF);
    while (line.flow_byte != 0) {
    }
    clock_wait_us(350);   /* at most one character in the UART goes before it */
}

void console_xon(void)
{
    if (line.xoffs != 0) {
        line.xoffs--;
    }
    end_xoff();
}

ring_t *console_rx_ring(void)
{
    return &line.rx;
}

volatile uint8_t *console_rx_lost(void)
{
    return &line.lost;
}

uint8_t console_received(void)
{
    return line.received;
}

uint8_t console_sent(void)
{
    return line.sent;
}

void console_counts(console_counts_t *counts)
{
    irq_state_t state = irq_save();
    *counts = line.counts;
    irq_restore(state);
    counts->ring_full = (uint8_t)(counts->ring_full + line.lost);
}

static inline void bump(uint8_t *count)
{
    if (*count != 0xFFu) {
        (*count)++;
    }
}

/* Under flow control: tells the PC to stop when the ring runs full, and again for every 32 bytes that still come. */
static inline void watch_room(void)
{
    if (!line.flow || ring_room(&line.rx) >= CONSOLE_XOFF_ROOM) {
        return;
    }
    if (!line.xoff_is_out || ++line.since_xoff == XOFF_AGAIN_BYTES) {
        line.xoff_is_out = true;
        line.since_xoff = 0;
        send_flow(CONSOLE_XOFF);
    }
}

/* Budget 160 cycles of the 2,800 between two characters at 57,600; 139 measured. */
ISR(USART1_RX_vect)
{
    uint8_t status = UCSR1A;   /* before UDR1: the flags are those of the byte there */
    uint8_t byte = UDR1;
    if (status & (1u << DOR1)) {
        bump(&line.counts.overruns);
    }
    if (status & (1u << FE1)) {
        bump(&line.counts.framing);
        return;
    }
    line.received++;
    if (!ring_put(&line.rx, byte)) {
        bump(&line.counts.ring_full);
    }
    watch_room();
}

/* Budget 100 cycles; 76 measured. */
ISR(USART1_UDRE_vect)
{
    uint8_t byte = line.flow_byte;
    if (byte != 0) {
        line.flow_byte = 0;
    } else if (!ring_get(&line.tx, &byte)) {
        UCSR1B = QUIET;
        return;
    }
    UDR1 = byte;
    UCSR1A = MODE_U2X | (1u << TXC1);   /* this byte has not left: transmit complete starts anew */
    line.has_sent = true;
    line.sent++;
}
