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
    bool moving;                 /* UDR still holds the character that is already in the shift register */
    uint8_t shift, udr;
    uint32_t rate_bps;           /* of the character in the shift register */
    uint64_t bit_cycles, ends_at;
    uint8_t fifo[3], flags[3];   /* two-character buffer, then the receive shift register */
    uint8_t fill;
    uint64_t freed_at;           /* when the receive shift register became free */
    uint64_t enabled_at;         /* RXEN set */
    uart_counts_t counts;
    /* Callbacks of the line: at the start of a character (may be NULL), and after its stop bit. */
    void (*begin)(void *line, uint8_t byte);
    void (*sent)(void *line, uint64_t now, uint8_t byte, uint32_t rate_bps);
    void *line;
} uart_t;

void uart_init(uart_t *uart, machine_t *machine, int index);
void uart_reset(uart_t *uart);
bool uart_is_sending(const uart_t *uart);

/* A character passed at rate_bps, beginning at cycle start. bad: framing error on the wire. */
void uart_receive(uart_t *uart, uint64_t start, uint8_t byte, uint32_t rate_bps, bool bad);

/* Computes what a receiver set to rate_to reads from a character sent at rate_from. false: framing error. */
bool uart_sample(uint8_t byte, uint32_t rate_from, uint32_t rate_to, uint8_t *seen);

#endif
