/* SPDX-License-Identifier: MIT
 * bus_core.h - the half-duplex engine behind bus.h, without registers: bytes and times in, states out.
 * Three callers: the main loop (submit, poll, cancel), the transmit-complete ISR (on_sent) and the receive ISR
 * (on_byte). Main-loop functions are safe against the two ISRs. RAM: one bus_core_t, 250 bytes.
 *
 *        submit                    the last byte went to the UART      transmit complete
 *  IDLE ---------> SENDING --------------------------------> TURNING -----------------> LISTENING
 *   ^                ^                                          |                        |  |
 *   |                |  a try is left (after a quiet 100 us)    |  no answer expected    |  |
 *   |                +------------------------------------------|------------------------+  |
 *   +-----------------------------------------------------------+---------------------------+
 *                                       answer complete, or the last try failed
 *
 * TURNING is left on transmit complete only, never on data register empty: until then the last bits are on the wire
 * and the line must not be released. */
#ifndef BUS_CORE_H
#define BUS_CORE_H

#include "bus.h"
#include "dxl_packet.h"

typedef enum { BUS_IDLE = 0, BUS_SENDING, BUS_TURNING, BUS_LISTENING } bus_state_t;

/* Flags of a received byte. */
enum { BUS_BYTE_FRAMING = 1 << 0, BUS_BYTE_OVERRUN = 1 << 1 };

typedef struct {
    volatile uint8_t state;       /* bus_state_t; ISR and main loop, see each transition */
    volatile uint8_t result;      /* bus_status_t of the packet; written on the way to IDLE or at a failed try */
    volatile bool failed;         /* LISTENING: this try has failed (ISR); poll decides on another one */
    uint8_t size, asked_id, answer_params;
    uint8_t tries_left;
    uint8_t byte_half_us;         /* time of one character */
    uint16_t return_delay_half_us;
    volatile uint16_t since;      /* when LISTENING began, or when a try failed; half us */
    uint16_t span;                /* time-out from then */
    ring_t *tap;
    bus_counts_t counts;
    dxl_parser_t parser;
    uint8_t packet[BUS_PACKET_BYTES];
} bus_core_t;

/* The port, given by hal/avr/bus.c or by a test. */
/* Turns the line to sending and starts to send; calls bus_core_on_last when the last byte went to the UART and
 * bus_core_on_sent when its last stop bit has left. `bytes` stays valid and unchanged until then. */
void bus_port_send(const uint8_t *bytes, uint8_t count);
/* Turns the line to listening. Called from bus_core_on_sent. What the receiver caught while it was not listening is
 * thrown away. */
void bus_port_listen(void);

void bus_core_init(bus_core_t *core);
void bus_core_set_rate(bus_core_t *core, uint8_t divisor);
bus_status_t bus_core_submit(bus_core_t *core, uint8_t size, uint8_t answer_params, uint8_t tries);
bus_status_t bus_core_poll(bus_core_t *core, uint16_t now_half_us, bus_answer_t *answer);
void bus_core_cancel(bus_core_t *core);

/* ISR side. */
void bus_core_on_last(bus_core_t *core);
void bus_core_on_sent(bus_core_t *core, uint16_t now_half_us);
void bus_core_on_byte(bus_core_t *core, uint8_t byte, uint8_t flags);

#endif
