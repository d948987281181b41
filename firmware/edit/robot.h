/* SPDX-License-Identifier: MIT
 * robot.h - the work pose and the servos: what is read from them and sent to them one by one while nothing plays.
 * Joint numbers are servo IDs 0..30, positions are page coordinates (trim is added here). Knows no command and no
 * screen. Main loop only; every call may block 1 to 4 ms a servo. RAM: 2 bytes. */
#ifndef ROBOT_H
#define ROBOT_H

#include <stdbool.h>
#include <stdint.h>
#include "page_store.h"
#include "performer.h"
#include "servo_link.h"
#include "session.h"

#define ROBOT_SLOWEST 8u   /* speed of a move: the way / 4, at least this (editor-original.md section 4) */

typedef struct {
    bool raw;             /* page 0 is open: no trim */
    uint8_t shown;        /* joint that robot_show_play took last */
    bool failed;          /* a joint did not answer (it is in the_servos.silent): the row has to say so */
} robot_t;

extern robot_t the_robot;       /* the only one: all functions here are about it */

/* What may not wait while something takes long: the tick, the bus. */
void robot_serve(void);

/* Reads trim and all joints that answered the last search. */
void robot_init(void);

/* Whether joint 0..30 is there; any number may be asked for. */
bool robot_has(uint8_t joint);

/* Reads the work pose anew: goal where torque is on, present position with the ???? mark where it is off. */
void robot_read(void);

/* The same for joints whose torque is off, from what the background polls have heard: costs no bus traffic. */
void robot_follow(void);

/* While something plays, once a tick: one joint's goal into the work pose, and its live position to be shown. */
void robot_show_play(void);

/* Opens a page, without trim when it is page 0. */
void robot_open_page(uint8_t page);

/* The page that is open has changed or trim was saved: page 0 is edited without trim. */
void robot_set_trim(void);

/* Moves one joint to `pos`, torque on; speed from the way it has to go. A joint that is not there only shows it. */
void robot_move(uint8_t joint, uint16_t pos);

/* Sends a step's words: positions move, ???? lets go, everything else is left alone. Returns the joints that are there
 * and had no position and no ????. */
uint32_t robot_send(const uint8_t step[PAGE_STEP_BYTES]);

/* Torque. On holds the present pose. */
void robot_on(uint32_t joints);
void robot_off(uint32_t joints);

#endif
