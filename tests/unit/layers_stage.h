/* SPDX-License-Identifier: MIT
 * layers_stage.h - what the tests of layers share: a main play over sparse pages with layers over it, all joints at 512. */
#ifndef LAYERS_STAGE_H
#define LAYERS_STAGE_H

#include "layers.h"
#include "sparse_pages.h"

#define ALL 0x7FFFFFFFul

extern player_t player;
extern player_joint_t joints[PAGE_JOINTS];
extern uint16_t goal_pos[PAGE_JOINTS];
extern link_t l;
extern layers_t layers;

/* For setUp: no play, no layer, no joint is anybody's. */
void layers_stage_reset(void);

/* Starts the main play at `page`, bound to the layers as they are. */
void layers_stage_start(uint8_t page, player_law_t law);

#endif
