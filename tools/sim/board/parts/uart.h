/* SPDX-License-Identifier: MIT
 * uart.h - USART0 and USART1. */
#ifndef SIM_UART_H
#define SIM_UART_H

#include "board_ports.h"
#include "machine.h"

typedef struct {
    machine_t *machine;
    uint8_t index, a, b, c;
    uint16_t ubrr;
    bool shifting, waiting;      /* transmitter: shift register, UDR */
    bool moving;                 /* UDR still holds the character that is in the shift register already */
    uint8_t shift, udr;
    uint32_t rate_bps;           /* of the character in the shift register */
    uint64_t bit_cycles, ends_at;
    uint8_t fifo[3], flags[3];   /* two-character buffer and the receive shift register behind it */
    uint8_t fill;
    uint64_t freed_at;           /* when the receive shift register became free */
    uint64_t enabled_at;         /* RXEN set */
    uart_counts_t counts;
    /* What hangs on it: a character begins to leave (NULL: nobody asks); one has left, stop bit included. */
    void (*begin)(void *line, uint8_t byte);
    void (*sent)(void *line, uint64_t now, uint8_t byte, uint32_t rate_bps);
    void *line;
} uart_t;

void uart_init(uart_t *uart, machine_t *machine, int index);
void uart_reset(uart_t *uart);
bool uart_is_sending(const uart_t *uart);

/* A character has passed at rate_bps, started at start; bad: the wire was not clean. */
void uart_receive(uart_t *uart, uint64_t start, uint8_t byte, uint32_t rate_bps, bool bad);

/* What a receiver set to rate_to sees of a character sent at rate_from; false: framing error. */
bool uart_sample(uint8_t byte, uint32_t rate_from, uint32_t rate_to, uint8_t *seen);

#endif
