/* SPDX-License-Identifier: MIT
 * uart.h - UART1 of the loader. Receives by interrupt (vectors in the boot section), and by service_poll while interrupts
 * are off for a flash page; sends by polling. Also the loader's clock, because its time limits are for silence on the line.
 * RAM: a ring of 256 bytes. Drops and counts bytes when the ring is full. */
#ifndef UART_H
#define UART_H

#include "boot_api.h"

#include <stdbool.h>
#include <stdint.h>

/* UBRR in double speed: rate = 2,000,000 / (UBRR + 1). */
#define UART_UBRR_57143 34
#define UART_UBRR_117647 16

/* A clock tick is 64 us; the clock wraps after 4.19 s. */
#define UART_TICKS(ms) ((uint16_t)((ms) * 15.625 + 0.5))

/* Sets the rate; switches on the receiver, its interrupt and the transmitter. Starts the clock but does not reset it. */
void uart_open(uint8_t ubrr);

/* Sends a byte. Waits until the UART takes it, at most one character. */
void uart_put(uint8_t byte);

/* Waits until everything has left. */
void uart_flush(void);

/* The number of received bytes, 0..255. peek and next return the next byte, which must exist; peek leaves it in the ring. */
uint8_t uart_has(void);
uint8_t uart_peek(void);
uint8_t uart_next(void);

/* Waits for a byte. false: none came within `ticks`. */
bool uart_wait(uint16_t ticks);

/* The same for this particular byte, which is taken. Also false if another byte came, which stays in the ring. */
bool uart_wait_for(uint8_t byte, uint16_t ticks);

/* Drops incoming bytes until the line has been silent for `ticks`. */
void uart_drain(uint16_t ticks);

/* The free-running clock, and the ticks since `then` (less than 4.19 s ago). */
uint16_t uart_clock(void);
uint16_t uart_since(uint16_t then);
void uart_pause(uint16_t ticks);

/* Bytes lost so far, modulo 256. */
uint8_t uart_lost(void);

/* The ring, for boot_write_page. */
extern const boot_rx_t uart_rx;

#endif
