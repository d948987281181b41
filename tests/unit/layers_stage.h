/* SPDX-License-Identifier: MIT
 * layers_stage.h - fixture for the tests of layers: a main play over sparse pages, layers on top, all joints at 512. */
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

/* For setUp: no play, no layer, no joint owned. */
void layers_stage_reset(void);

/* Starts the main play at `page`, bound to the current layers. */
void layers_stage_start(uint8_t page, player_law_t law);

#endif
