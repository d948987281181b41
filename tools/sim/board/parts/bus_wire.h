/* SPDX-License-Identifier: MIT
 * bus_wire.h - between UART0 and the servos: direction pins and bus timing. */
#ifndef SIM_BUS_WIRE_H
#define SIM_BUS_WIRE_H

#include "servo_bus.h"
#include "uart.h"

typedef struct {
    machine_t *machine;
    uart_t *uart;
    board_kind_t kind;
    servo_bus_t *bus;
    uint64_t listening_since; /* NEVER: not listening */
    uint64_t sent_at;         /* end of our last stop bit; NEVER: the board has listened since */
    uint64_t longest_turn;
    uint64_t character_end; /* in the packet that the board is sending; NEVER: before its first character */
    uint64_t longest_pause;
} bus_wire_t;

bool bus_wire_init(bus_wire_t *wire, machine_t *machine, uart_t *uart, board_kind_t kind); /* false: out of memory */
void bus_wire_free(bus_wire_t *wire);
void bus_wire_follow(bus_wire_t *wire); /* schedules the bus's next event */
void bus_wire_power(bus_wire_t *wire, bool on);
void bus_wire_supply(bus_wire_t *wire, double volts);
void bus_wire_body(bus_wire_t *wire, const servo_body_t *body);
void bus_wire_pins(bus_wire_t *wire, uint8_t before, uint8_t after); /* port E outputs driven high */

#endif
