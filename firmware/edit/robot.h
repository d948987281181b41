/* SPDX-License-Identifier: MIT
 * robot.h - the work pose and the servos: reads servos and moves them one by one while nothing is playing.
 * Joint numbers are servo IDs 0..30, positions are page coordinates (trim is added here). Knows no command and no
 * screen. Main loop only; a call may block 1 to 4 ms per servo. */
#ifndef ROBOT_H
#define ROBOT_H

#include <stdbool.h>
#include <stdint.h>
#include "page_store.h"
#include "performer.h"
#include "servo_link.h"
#include "session.h"

#define ROBOT_SLOWEST 8u   /* the speed of a move is the distance / 4, at least this (ORIGINAL.md section 4) */

typedef struct {
    bool raw;             /* no trim */
    uint8_t shown;        /* the joint that robot_follow_play updated last */
    uint32_t played;      /* joints that the play has moved */
    uint32_t failed;      /* joints that did not obey or answer (the_servos.silent), not yet shown on the row */
} robot_t;

extern robot_t the_robot;       /* the only instance: all functions here use it */

/* Serves the tick and the bus; call it during long work. */
void robot_serve(void);

/* Reads the trim and all joints that answered the last search. */
void robot_init(void);

/* Whether this joint is present. */
bool robot_has(uint8_t joint);

/* Reads the work pose: for joints with torque the goal, for the others the present position with the ???? mark. */
void robot_read(void);

/* The same for joints without torque, from the background polls, without bus traffic. */
void robot_follow(void);

/* Call once per tick during a play. is_shown: copies one joint's goal to the work pose and marks its live position. */
void robot_follow_play(bool is_shown);

/* Call when a play has ended: the work pose becomes the goals of the servos. Silent servos keep the last goals sent. */
void robot_end_play(void);

/* Opens a page; page 0 without trim. */
void robot_open_page(uint8_t page);

/* Sets the trim again. Call after another page was opened or the trim was saved: page 0 is edited without trim. */
void robot_set_trim(void);

/* Call when a play has begun, before it reads the pose: pages are played with the trim while page 0 is open, too. */
void robot_trim_play(void);

/* Moves one joint to `pos` and switches its torque on; the speed depends on the distance. Only shows the position of an
 * absent joint. */
void robot_move(uint8_t joint, uint16_t pos);

/* Sends the words of a step: a position moves the joint, ???? switches its torque off, other words do nothing. Returns the
 * present joints with other words. */
uint32_t robot_send(const uint8_t step[PAGE_STEP_BYTES]);

/* Switches the torque of the present joints. Switching on holds the present pose. */
void robot_switch(uint32_t joints, bool on);

#endif
