/* SPDX-License-Identifier: MIT
 * console.h - the serial line to terminal, PC and remote control (UART 1, 57,600 baud 8N1), by interrupt.
 * Bytes only: knows no lines and no packets. Main loop only. RAM: the rings CONSOLE_RX_BYTES and CONSOLE_TX_BYTES, and a
 * few bytes. No byte is lost at full line rate if the main loop takes bytes every 44 ms (255 bytes; 22 ms with a ring of
 * 128), or with flow control on. Interrupts may be off for 350 us: the UART buffers two characters. */
#ifndef CONSOLE_H
#define CONSOLE_H

#include <stdbool.h>
#include <stdint.h>
#include "ring.h"

/* An image may define these smaller (powers of two, for the whole image). The loader's page-write needs 256 for input. */
#ifndef CONSOLE_RX_BYTES
#define CONSOLE_RX_BYTES 256u
#endif
#ifndef CONSOLE_TX_BYTES
#define CONSOLE_TX_BYTES 128u
#endif

/* Rates by divisor: 2,000,000 / (n + 1). */
#define CONSOLE_RATE_57600 34u  /* really 57,143 */
#define CONSOLE_RATE_115200 16u /* really 117,647 */

#define CONSOLE_XON 0x11u
#define CONSOLE_XOFF 0x13u

/* Errors since start. Each count stops at 255. */
typedef struct {
    uint8_t overruns;   /* the UART lost bytes: interrupts were off too long */
    uint8_t framing;    /* a character without a stop bit: noise or a wrong rate (the byte is dropped) */
    uint8_t ring_full;  /* bytes dropped because the main loop did not take them in time */
} console_counts_t;

/* Sets every register of UART 1 (the loader leaves it running) and empties both rings. Drops bytes that the loader left in
 * the UART. Call before interrupts are enabled. */
void console_init(void);

/* Waits until all output has left, then changes the rate (a CONSOLE_RATE_ divisor). Keeps the rings. */
void console_set_rate(uint8_t divisor);

/* Input. */
bool console_get(uint8_t *byte);     /* false: no byte */
bool console_peek(uint8_t *byte);    /* the byte that console_get would take; false: no byte */
uint8_t console_waiting(void);       /* bytes to get */

/* The number of bytes lost just before the last byte from console_get (overrun, framing, ring full); at most 127. A line
 * with such a byte is not the line that was sent. If bytes were lost in several places before any was taken, each waiting
 * byte before the last loss counts as lossy, and the byte after it has the number. */
uint8_t console_lost(void);
void console_drop_input(void);

/* Output, non-blocking. false: no room, the byte was not taken. */
bool console_put(uint8_t byte);
uint8_t console_room(void);          /* 0..CONSOLE_TX_BYTES */

/* Output, blocking until the last byte is in the ring: up to 175 us per byte while the ring is full. Interrupts must be on.
 * Does not kick the watchdog: pass at most 5 KB per call. */
void console_write(const void *bytes, uint16_t count);

/* Blocks until the last stop bit is on the wire (at most 23 ms). */
void console_flush(void);

/* Software flow control towards the PC; off after init. When on, XOFF is sent ahead of the output ring as soon as the input
 * ring has less than CONSOLE_XOFF_ROOM bytes left, and again for every 32 bytes that still arrive. XON is sent when the ring
 * is nearly empty. Switching on sends XON, because the PC may still obey an XOFF from before a restart. Switching off sends
 * XON if an XOFF is in force. XON and XOFF from the PC are data: they occur in remote packets. */
#define CONSOLE_XOFF_ROOM (CONSOLE_RX_BYTES / 2u)
#define CONSOLE_XON_COUNT 32u
void console_set_flow(bool on);

/* console_xoff sends XOFF now, blocks until it has left, and keeps the PC silent until console_xon. Call it before
 * interrupts go off (a page write). Calls are counted (at most 255), so that two parts of an image may stop the PC at once:
 * it resumes after as many calls of console_xon. Both do nothing while flow control is off. */
void console_xoff(void);
void console_xon(void);

/* For the page-write service of the boot loader, which receives while interrupts are off: the input ring (256 bytes,
 * free-running indices, index mask 0xFF), and the count of bytes that the service dropped (part of ring_full). */
ring_t *console_rx_ring(void);
volatile uint8_t *console_rx_lost(void);

/* Free-running counts of bytes, modulo 256, for traffic lamps. */
uint8_t console_received(void);
uint8_t console_sent(void);

void console_counts(console_counts_t *counts);

#endif
