/* SPDX-License-Identifier: MIT */
#include "console.h"
#include "clock.h"
#include "compiler.h"
#include "irq.h"

#include <avr/io.h>
#include <string.h>

/* Whole-register values instead of read-modify-write, because both main loop and ISRs set them. */
#define MODE_U2X (1u << U2X1)
#define FRAME_8N1 ((1u << UCSZ11) | (1u << UCSZ10))
#define QUIET ((1u << RXEN1) | (1u << TXEN1) | (1u << RXCIE1))
#define TALKING (QUIET | (1u << UDRIE1))
#define XOFF_AGAIN_BYTES 32u
#define HOLES_MAX 0x7Fu
#define HOLES_WIDE 0x80u

static uint8_t rx_storage[CONSOLE_RX_BYTES], tx_storage[CONSOLE_TX_BYTES];

static struct {
    ring_t rx;                       /* in: ISR (and the loader's page-write); out: main */
    ring_t tx;                       /* in: main; out: ISR */
    volatile uint8_t flow_byte;      /* XON or XOFF to send first; 0: none */
    volatile uint8_t received, sent; /* ISR */
    volatile uint8_t lost;           /* the loader's page-write */
    volatile uint8_t holes;          /* bytes lost, at most HOLES_MAX; HOLES_WIDE: in several places ... */
    volatile uint8_t hole_at;        /* ... and the last loss was before this index of rx (modulo 256) */
    uint8_t lost_here;               /* for console_lost */
    volatile bool xoff_is_out;       /* under flow control: XOFF was sent to the PC */
    volatile uint8_t since_xoff;     /* bytes received after it, modulo XOFF_AGAIN_BYTES */
    volatile bool has_sent;          /* a byte was sent, so TXC is valid */
    bool flow;
    uint8_t xoffs;                   /* calls of console_xoff without a matching console_xon */
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

/* Sends XON once no reason for an XOFF remains. */
static void end_xoff(void)
{
    if (line.xoff_is_out && line.xoffs == 0 && ring_count(&line.rx) <= CONSOLE_XON_COUNT) {
        line.xoff_is_out = false;
        send_flow(CONSOLE_XON);
    }
}

/* Records that bytes were lost before the next byte of the ring. ISR, or interrupts off. */
static inline void note_hole(uint8_t count)
{
    const uint8_t at = line.rx.head, left = HOLES_MAX - (line.holes & HOLES_MAX);
    const uint8_t wide = line.holes != 0 && at != line.hole_at ? HOLES_WIDE : (uint8_t)(line.holes & HOLES_WIDE);
    line.holes = (uint8_t)(wide | ((line.holes & HOLES_MAX) + (count < left ? count : left)));
    line.hole_at = at;
}

/* The loader only counts its losses during a page-write, so they may be anywhere among the waiting bytes. */
static void take_losses_of_loader(void)
{
    const uint8_t lost = line.lost;
    if (lost != 0) {
        line.lost = 0;
        line.counts.ring_full = (uint8_t)(line.counts.ring_full > 0xFFu - lost ? 0xFFu : line.counts.ring_full + lost);
        note_hole(lost);
        line.holes |= HOLES_WIDE;
    }
}

/* Returns the number of bytes lost before index `at`, whose byte is taken now. */
static uint8_t take_holes(uint8_t at)
{
    irq_state_t state = irq_save();
    take_losses_of_loader();
    uint8_t lost = (uint8_t)(line.holes >> 7);
    if (line.holes != 0 && at == line.hole_at) {
        lost = line.holes & HOLES_MAX;
        line.holes = 0;
    }
    irq_restore(state);
    return lost;
}

bool console_get(uint8_t *byte)
{
    const uint8_t at = line.rx.tail;
    if (!ring_get(&line.rx, byte)) {
        return false;
    }
    line.lost_here = take_holes(at);
    end_xoff();
    return true;
}

bool console_peek(uint8_t *byte)
{
    return ring_peek(&line.rx, byte);
}

uint8_t console_lost(void)
{
    return line.lost_here;
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
    clock_wait_us(350);   /* at most one character in the UART precedes it */
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
    take_losses_of_loader();
    *counts = line.counts;
    irq_restore(state);
}

static inline void bump(uint8_t *count)
{
    if (*count != 0xFFu) {
        (*count)++;
    }
}

/* Under flow control: sends XOFF when the ring runs full, and again for every 32 bytes that still arrive. */
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

/* Budget: 160 of the 2,800 cycles between two characters at 57,600; 139 measured. */
ISR(USART1_RX_vect)
{
    uint8_t status = UCSR1A;   /* before UDR1: its flags belong to the byte there */
    uint8_t byte = UDR1;
    if (status & (1u << DOR1)) {
        bump(&line.counts.overruns);
        note_hole(1);
    }
    if (status & (1u << FE1)) {
        bump(&line.counts.framing);
        note_hole(1);
        return;
    }
    line.received++;
    if (!ring_put(&line.rx, byte)) {
        bump(&line.counts.ring_full);
        note_hole(1);
    }
    watch_room();
}

/* Budget: 100 cycles; 76 measured. */
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
    UCSR1A = MODE_U2X | (1u << TXC1);   /* this byte has not left yet: clears transmit complete */
    line.has_sent = true;
    line.sent++;
}
