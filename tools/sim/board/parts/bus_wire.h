/* SPDX-License-Identifier: MIT
 * bus_wire.h - between UART0 and the servos: the direction pins, and the time scale of the bus. */
#ifndef SIM_PARTS_BUS_WIRE_H
#define SIM_PARTS_BUS_WIRE_H

#include "board_ports.h"

typedef struct {
    struct servo_bus *bus;
    uint64_t listening_since; /* NEVER: not listening */
    uint64_t sent_at;         /* when our last stop bit left; NEVER: the board has listened since */
    uint64_t longest_turn;
} bus_wire_t;

bool bus_wire_init(board_t *board);
void bus_wire_free(board_t *board);
void bus_wire_follow(board_t *board); /* takes over the bus's next event */
void bus_wire_event(board_t *board, uint64_t now);
void bus_wire_supply(board_t *board, double volts);
void bus_wire_pins(board_t *board, uint8_t before, uint8_t after); /* port E outputs that are driven high */

#endif
