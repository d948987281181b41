/* SPDX-License-Identifier: MIT
 * performer_shape.h - shapes a play from outside: a second page on some of the joints, and driving by a program
 * (motion/SHAPING.md). Rate, amplitude and blend are set directly in performer.shape (shape.h).
 * Main loop only. RAM: layers_t, the image's.
 *
 * An image without this links performer_shape_none.c. */
#ifndef PERFORMER_SHAPE_H
#define PERFORMER_SHAPE_H

#include "layers.h"
#include "performer.h"

/* Call after performer_init. Keeps using the caller's layers. */
void performer_set_layers(performer_t *performer, layers_t *layers);

/* Plays `page` on `joints` (0: those that its first step uses) over the main play, with slopes of its own.
 * LAYERS_ERR_IDLE: there is no main play, or it is paused or ending. LAYERS_ERR_PAGE and _EMPTY: see performer.fault_page
 * and .fault. */
MUST_CHECK layers_status_t performer_layer(performer_t *performer, uint8_t page, uint32_t joints);
void performer_layer_off(performer_t *performer);
uint8_t performer_layer_page(const performer_t *performer);     /* 0: none */

/* Call before layers_aim and layers_swing of joint `id`. If nothing is playing, switches its torque on and reads its pose,
 * which blocks 6 ms at most. LAYERS_ERR_FULL: see layers.h. LAYERS_ERR_BUSY: a play is about to begin, or a break is ending
 * it, which will free all joints. LAYERS_ERR_JOINTS: the joint does not answer, was switched off by hand or has been dropped
 * from the play. */
MUST_CHECK layers_status_t performer_take_for_code(performer_t *performer, uint8_t id);

/* Sets blend, rate and amplitude (of all joints) in percent, in the ranges of shape_t, until the play ends. The next call
 * must come within the setting `drive`; otherwise the play ends through its exit page. */
void performer_drive(performer_t *performer, int8_t blend, uint16_t rate, uint8_t amplitude);

/* ---- for performer*.c ---- */

/* The joints that the page layer or code moves. */
uint32_t performer_layers_joints(const performer_t *performer);

/* Whether the layers may still move a joint by themselves. */
bool performer_layers_are_moving(const performer_t *performer);

/* One tick of the layers and, if with_play, of the player. Returns the player's PLAYER_EV_ bits; PLAYER_EV_OUTPUT covers the
 * layers too. */
uint8_t performer_layers_tick(performer_t *performer, bool with_play);

/* player_plan of all plays. Call after a tick's goals are sent. */
void performer_layers_plan(performer_t *performer);

/* Replaces the main page's compliance bytes by the layer's, for the joints that the layer moves. */
void performer_layers_slopes(const performer_t *performer, uint8_t compliance[PAGE_JOINTS]);

/* with_play: from now on performer.player holds a play. false: its memory is free for other use. */
void performer_layers_bind(performer_t *performer, bool with_play);

void performer_layers_drop(performer_t *performer, uint32_t joints);
void performer_layers_break(performer_t *performer);
void performer_layers_pause(performer_t *performer, bool pause);

/* Updates the shape: centre page from the settings, limit from the current battery voltage. */
void performer_shape_follow(performer_t *performer);

/* Call once per tick. true: the next performer_drive is overdue. The time does not run during a pause, so that nothing moves
 * before the resume. */
bool performer_drive_is_lost(performer_t *performer);

/* Call at the end of a play: resets the shape if performer_drive has set it. */
void performer_drive_end(performer_t *performer);

#endif
