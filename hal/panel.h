/* SPDX-License-Identifier: MIT
 * panel.h - lamps and buttons of the CM-5. The CM-2's are unknown, so there it does nothing and reports no buttons.
 * Also sets the pins that only need a safe level: charger off, ZigBee out of reset, both receive gates open.
 * Main loop only. Source: BOARD.md, "CM-5 pins". */
#ifndef PANEL_H
#define PANEL_H

#include <stdbool.h>
#include <stdint.h>

/* Lamps, bits of a mask. */
enum {
    PANEL_LED_POWER = 1 << 0,
    PANEL_LED_TXD = 1 << 1,
    PANEL_LED_RXD = 1 << 2,
    PANEL_LED_AUX = 1 << 3,
    PANEL_LED_MANAGE = 1 << 4,
    PANEL_LED_PROGRAM = 1 << 5,
    PANEL_LED_PLAY = 1 << 6,
    PANEL_LED_ALL = 0x7F
};

/* Buttons, bits of a mask; the arrows have the values of the remote's codes (REMOTE.md). */
enum {
    PANEL_UP = 1 << 0,
    PANEL_DOWN = 1 << 1,
    PANEL_LEFT = 1 << 2,
    PANEL_RIGHT = 1 << 3,
    PANEL_START = 1 << 4,
    PANEL_ARROWS = 0x0F
};

/* All lamps except Power off; pull-ups on; charger off; ZigBee running; PC and remote lines gated in. */
void panel_init(void);

void panel_set(uint8_t leds, bool on);   /* other lamps are unchanged */
uint8_t panel_lit(void);

/* Call once per tick: samples the buttons. A change takes effect after PANEL_STEADY_TICKS equal samples in a row (23 ms). */
#define PANEL_STEADY_TICKS 3u
void panel_tick(void);

uint8_t panel_buttons(void);   /* held now, debounced */

/* Current buttons, not debounced (for start-up). */
uint8_t panel_buttons_now(void);

#endif
