/* SPDX-License-Identifier: MIT
 * fake_panel.h - the hand on the buttons and the eye on the lamps, behind panel.h. Debounced as on the robot. */
#ifndef FAKE_PANEL_H
#define FAKE_PANEL_H

#include <stdbool.h>
#include <stdint.h>

void fake_panel_reset(void);                      /* a board with panel, nothing pressed */
void fake_panel_press(uint8_t buttons);           /* these are down, all others up (PANEL_ bits) */
void fake_panel_set_there(bool there);            /* false: as on a CM-2 */

#endif
