/* SPDX-License-Identifier: MIT
 * fake_panel.h - presses the buttons and reads the LEDs of panel.h. Debounced as on the robot. */
#ifndef FAKE_PANEL_H
#define FAKE_PANEL_H

#include <stdint.h>

void fake_panel_reset(void);                      /* a board with panel, no button pressed */
void fake_panel_press(uint8_t buttons);           /* presses these (PANEL_ bits), releases all others */

#endif
