/* SPDX-License-Identifier: MIT
 * performer_shape.h - what shapes a play from outside while it plays: a second page on joints of its own, and driving
 * by a program (shaping.md). Rate, amplitude and blend are set directly in performer.shape (shape.h).
 * Main loop only. RAM: layers_t, handed over by the image.
 *
 * An image without layers links performer_layers_none.c, one that nobody drives performer_drive_none.c. */
#ifndef PERFORMER_SHAPE_H
#define PERFORMER_SHAPE_H

#include "layers.h"
#include "performer.h"

/* After performer_init. The layers stay the caller's and are used from now on. */
void performer_set_layers(performer_t *performer, layers_t *layers);

/* Plays `page` on `joints` (0: those that its first step uses) over the main play, with slopes of its own.
 * LAYERS_ERR_IDLE: no main play is on, or it is paused or ending. performer.fault_page and .fault tell of
 * LAYERS_ERR_PAGE and _EMPTY. */
MUST_CHECK layers_status_t performer_layer(performer_t *performer, uint8_t page, uint32_t joints);
void performer_layer_off(performer_t *performer);
uint8_t performer_layer_page(const performer_t *performer);     /* 0: none */

/* Before layers_aim and layers_swing of joint `id`: makes it ready. While nothing plays its torque goes on and its pose is
 * read, which blocks 6 ms at most. LAYERS_ERR_FULL. LAYERS_ERR_BUSY: a play is about to begin. LAYERS_ERR_JOINTS: it does
 * not answer, was switched off by hand or has been dropped from the play. */
MUST_CHECK layers_status_t performer_take_for_code(performer_t *performer, uint8_t id);

/* One line of a joystick: blend, rate and amplitude (of all joints), percent; all or, when one is out of range, none: false.
 * From then on another one has to come within the setting `drive`, or the play ends through its exit page. What was set
 * ends with the play. */
MUST_CHECK bool performer_drive(performer_t *performer, int16_t blend, uint16_t rate, uint16_t amplitude);

/* ---- for performer*.c ---- */

/* Joints that the layer moves: they belong to nobody else. */
uint32_t performer_layers_joints(const performer_t *performer);

/* Whether they may still move something by themselves. */
bool performer_layers_are_moving(const performer_t *performer);

/* One tick. with_play: of the player as well. Returns the player's PLAYER_EV_ bits; PLAYER_EV_OUTPUT for the layers too. */
uint8_t performer_layers_tick(performer_t *performer, bool with_play);

/* Puts the layer's compliance bytes in the place of the main page's, for the joints that it moves. */
void performer_layers_slopes(const performer_t *performer, uint8_t compliance[PAGE_JOINTS]);

/* The memory of the main play is the player's from now on, or something else's (false). */
void performer_layers_bind(performer_t *performer, bool with_play);

void performer_layers_drop(performer_t *performer, uint32_t joints);
void performer_layers_break(performer_t *performer);
void performer_layers_pause(performer_t *performer, bool pause);

/* The shape takes over the centre page of the settings, and for its limit the battery's present voltage. */
void performer_shape_follow(performer_t *performer);

/* Once a tick: the time without performer_drive. true: it is over. */
bool performer_drive_is_lost(performer_t *performer);

/* The play is over: what performer_drive has set ends. */
void performer_drive_end(performer_t *performer);

#endif
