/* SPDX-License-Identifier: MIT
 * sequence.h - which page and step come next, and their positions. For player.c. */
#ifndef SEQUENCE_H
#define SEQUENCE_H

#include "link.h"
#include "player_state.h"

/* Finds the page that plays first; `next` is its first step. false: there is none; only .fault and .fault_page have
 * changed. */
bool sequence_start(player_t *player, link_t *link, uint8_t named);

/* `next` becomes `now`; the step after it becomes `next`. At the last step of the last repetition this decides the link.
 * Returns PLAYER_EV_ bits. Call it only if next.page is not 0. */
uint8_t sequence_advance(player_t *player, link_t *link);

/* Reads what a step contains.
 * words     : its position words, shaped unless shape is NULL
 * positions : the same into next_pos, where a joint that it does not use stays on its target; returns the joints that it
 *             uses (page 0: none)
 * next      : all of `next` */
void sequence_read_next(player_t *player);
uint32_t sequence_read_positions(player_t *player, uint8_t page, uint8_t step);
void sequence_read_words(const page_source_t *source, const shape_t *shape, uint8_t page, uint8_t step,
                         uint16_t words[PAGE_JOINTS]);

#endif
