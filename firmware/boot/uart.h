/* SPDX-License-Identifier: MIT
 * uart.h - UART1 of the loader: received by interrupt (vectors in the boot section) or, while interrupts are off for a
 * flash page, by service_poll; sent by polling. Also the loader's clock, because every time limit here is one of
 * silence on the line. RAM: 256-byte ring and 7 bytes. A byte that finds the ring full is dropped and counted. */
#ifndef UART_H
#define UART_H

#include "boot_api.h"

#include <stdbool.h>
#include <stdint.h>

/* UBRR in double speed: rate = 2,000,000 / (UBRR + 1). */
#define UART_UBRR_57143 34
#define UART_UBRR_117647 16

/* Clock ticks are 64 us, the clock wraps after 4.19 s. */
#define UART_TICKS(ms) ((uint16_t)((ms) * 15.625 + 0.5))

/* Sets the rate and switches the receiver, its interrupt and the transmitter on. Also starts the clock; it is not reset. */
void uart_open(uint8_t ubrr);

/* Sends a byte; waits while the one before is still on its way to the shift register. */
void uart_put(uint8_t byte);

/* Waits until everything has left. */
void uart_flush(void);

/* Received bytes that wait, 0..255; the next of them, to look at or to take: only when there is one. */
uint8_t uart_has(void);
uint8_t uart_peek(void);
uint8_t uart_next(void);

/* Waits until a byte is there: true; or until `ticks` have passed: false. */
bool uart_wait(uint16_t ticks);

/* The same for one byte alone, which is taken; another one stays. */
bool uart_wait_for(uint8_t byte, uint16_t ticks);

/* Drops what comes until the line has been silent for `ticks`. */
void uart_drain(uint16_t ticks);

/* The clock runs freely: ask how long ago something was, in ticks (below 4.19 s). */
uint16_t uart_clock(void);
uint16_t uart_since(uint16_t then);
void uart_pause(uint16_t ticks);

/* Counts the bytes lost, modulo 256. */
uint8_t uart_lost(void);

/* The ring, for boot_write_page. */
extern const boot_rx_t uart_rx;

#endif
