/* SPDX-License-Identifier: MIT
 * player_stage.h - fixture for the player tests: a player over sparse pages, all joints at 512. Contains setUp and
 * tearDown. */
#ifndef PLAYER_STAGE_H
#define PLAYER_STAGE_H

#include "player.h"
#include "sparse_pages.h"

#define ALL 0x7FFFFFFFul
#define TICKS_MAX 4000u

extern player_t player;
extern link_t l;
extern uint16_t pose[PAGE_JOINTS];

void start_law(uint8_t page, player_law_t law);
void start(uint8_t page); /* with the exact law */

/* Ticks until one of `events` occurs. Returns the ticks; *seen gets the events of the last one. */
uint16_t run_until(uint8_t events, uint8_t *seen);
uint16_t run_to_end(void);

#endif
