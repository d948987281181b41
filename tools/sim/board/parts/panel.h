/* SPDX-License-Identifier: MIT
 * panel.h - LEDs, buttons, charger, battery; and every write to a port, since other parts hang on pins too. */
#ifndef SIM_PARTS_PANEL_H
#define SIM_PARTS_PANEL_H

#include <simavr/sim_avr.h>

#include "board_ports.h"
#include "m128.h"

typedef struct {
    uint8_t pressed; /* bit n: button_t n */
    uint64_t bounce;                      /* how long a contact bounces; until when each does */
    uint64_t bounces_until[BUTTON_COUNT];
    uint8_t leds;
    /* simavr's own handlers of the port registers, called first so that its pin signals stay right */
    struct { avr_io_write_t write; void *param; } inner[M128_PORTB + 1];
    double battery_v, thermistor_v;
} panel_t;

void panel_init(board_t *board);
void panel_reset(board_t *board);
void panel_event(board_t *board, uint64_t now); /* the charger's grace time is over */

#endif
