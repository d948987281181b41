/* SPDX-License-Identifier: MIT
 * quick.h - the robot without its chip: the firmware's player (motion/), the virtual servos, and a body, in one loop.
 * For campaigns and searches, where the simulated ATmega128 would cost most of the time. What it leaves out: the wire (goals
 * reach the servos 1/1024 s after their tick, as a SYNC WRITE of 18 joints does), the console, the approach, the servos'
 * answers. Slopes come from the pages, as the firmware sends them. Single-threaded; any number may exist. */
#ifndef SIM_QUICK_H
#define SIM_QUICK_H

#include "player.h"
#include "servo_bus.h"

#define QUICK_IMAGE_BYTES (PAGE_COUNT * PAGE_BYTES)

typedef struct quick quick_t;

/* What the servos went through since the start of a play. */
typedef struct {
    double torque_nm;    /* mean size of the motor's torque */
    double torque2_nm2;  /* mean square: what heats */
    double most_degrees_c;
    double most_units_per_tick; /* the fastest change of the goal */
} quick_load_t;

/* A robot without servos; image: QUICK_IMAGE_BYTES as they lie in flash, copied. NULL: no memory. */
quick_t *quick_new(const uint8_t *image);
void quick_free(quick_t *quick);

/* Plug servos in with servo_bus_add(), hang them on a body with servo_bus_body(). */
servo_bus_t *quick_bus(quick_t *quick);
uint64_t quick_now(const quick_t *quick);

/* Torque on, each joint's goal where it stands: what the robot does before a play. */
void quick_torque_on(quick_t *quick);

/* Begins to play from where the joints' goals are. Returns player_status_t. The loads are counted from here on. */
int quick_start(quick_t *quick, uint8_t page, int law);

/* Plays by a copy of `shape` from the next step that is looked at (shape.h). */
void quick_shape(quick_t *quick, const shape_t *shape);

/* A remote's keys from now on: 0 let go, 255 stop. */
void quick_keys(quick_t *quick, uint8_t code);

/* Lets so many ticks pass. Returns true while a play is on. */
bool quick_run(quick_t *quick, uint32_t ticks);

/* What is played now (0, 0: nothing) and the fault that ended the play (page_status_t). */
int quick_page(const quick_t *quick);
int quick_step(const quick_t *quick);
int quick_fault(const quick_t *quick);

/* The goal of a joint, 0..1023. */
int quick_goal(const quick_t *quick, uint8_t joint);

/* Loads of the servo with this index, in order of plugging in. */
quick_load_t quick_load(const quick_t *quick, int index);

#endif
