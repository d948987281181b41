/* SPDX-License-Identifier: MIT
 * performer_stage.h - fixture for the performer tests: three fake servos, eight pages, and time.
 *
 * Page 1: joint 1 to 612 in 64 ticks. Page 2: the same in a loop; a stop leads to page 3. Page 3: to 412. The others
 * have no action. Approach at 60 degrees/s, battery low below 10.0 V, hot from 70 degrees C. Contains setUp and
 * tearDown. */
#ifndef PERFORMER_STAGE_H
#define PERFORMER_STAGE_H

#include "fake_servo_link.h"
#include "performer.h"
#include "performer_shape.h"

#define PAGES 8u
#define ALL_THREE (SERVO_LINK_BIT(1) | SERVO_LINK_BIT(2) | SERVO_LINK_BIT(3))

extern uint8_t pages[PAGES][PAGE_BYTES];
extern servo_link_t servos;
extern settings_t settings;
extern performer_t performer;
extern layers_t layers;

/* A page with one step of 64 ticks that moves joint 1 to `pos`. Next link `next`, exit link `exit`. */
void make_page(uint8_t page, uint16_t pos, uint8_t next, uint8_t exit);

/* Runs ticks and the main loop between them. */
void ticks(uint16_t count);

/* Runs ticks until this state. */
void reach(uint8_t state);

/* Starts a page and expects success. */
void start(uint8_t page, uint8_t code);

/* Returns the next event of this kind and drops others. Fails if there is none. */
performer_event_t expect_event(uint8_t kind);
bool has_event(uint8_t kind);

/* PERFORMER_END_... reason of the next end event. */
uint8_t end_reason(void);

#endif
