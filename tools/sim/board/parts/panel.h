/* SPDX-License-Identifier: MIT
 * panel.h - LEDs, buttons, charger, battery, and all writes to ports, because other parts use pins too. */
#ifndef SIM_PANEL_H
#define SIM_PANEL_H

#include "bus_wire.h"

typedef struct {
    machine_t *machine;
    bus_wire_t *wire;
    board_kind_t kind;
    uint8_t pressed; /* bit n: button_t n */
    uint64_t bounce;                      /* duration of contact bounce; end of each button's bounce */
    uint64_t bounces_until[BUTTON_COUNT];
    uint8_t leds;
    /* simavr's own handlers of the port registers, called first to keep its pin signals right */
    struct { avr_io_write_t write; void *param; } inner[M128_PORTB + 1];
    double battery_v;
} panel_t;

void panel_init(panel_t *panel, machine_t *machine, bus_wire_t *wire, board_kind_t kind);
void panel_reset(panel_t *panel);
void panel_press(panel_t *panel, button_t button, bool down); /* any button except MODE, which is the reset pin */
void panel_battery(panel_t *panel, double volts);

#endif
