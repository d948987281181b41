/* SPDX-License-Identifier: MIT
 * robot.h - the work pose and the servos: reads servos and moves them one by one while nothing plays.
 * Joint numbers are servo IDs 0..30, positions are page coordinates (trim is added here). Knows no command and no
 * screen. Main loop only; a call may block 1 to 4 ms a servo. */
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
    bool raw;             /* page 0 is open: no trim */
    uint8_t shown;        /* the joint that robot_follow_play updated last */
    uint32_t played;      /* joints that the play has moved */
    uint32_t failed;      /* joints that did not obey or did not answer (the_servos.silent); to be shown on the row */
} robot_t;

extern robot_t the_robot;       /* the only one: all functions here are about it */

/* Serves the tick and the bus; call it within long work. */
void robot_serve(void);

/* Reads trim and all joints that answered the last search. */
void robot_init(void);

/* Whether this joint is present. */
bool robot_has(uint8_t joint);

/* Reads the work pose anew: the goal of joints with torque, the present position and the ???? mark of the others. */
void robot_read(void);

/* The same for joints without torque, from the background polls: no bus traffic. */
void robot_follow(void);

/* Call once a tick while something plays. is_shown: copies one joint's goal to the work pose and marks its live position. */
void robot_follow_play(bool is_shown);

/* Call when a play has ended: the work pose becomes the goals of the servos. Those that do not answer have the last ones
 * that were sent. */
void robot_end_play(void);

/* Opens a page, without trim when it is page 0. */
void robot_open_page(uint8_t page);

/* Sets the trim again. Call when another page was opened or trim was saved: page 0 is edited without trim. */
void robot_set_trim(void);

/* Moves one joint to `pos` and switches its torque on; the speed follows from the distance. A joint that is not present only
 * shows the position. */
void robot_move(uint8_t joint, uint16_t pos);

/* Sends the words of a step: a position moves the joint, ???? switches its torque off, other words do nothing. Returns the
 * present joints with such other words. */
uint32_t robot_send(const uint8_t step[PAGE_STEP_BYTES]);

/* Switches the torque of the joints that are present. On keeps the present pose. */
void robot_switch(uint32_t joints, bool on);

#endif
