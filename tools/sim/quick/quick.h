/* SPDX-License-Identifier: MIT
 * quick.h - the robot without its chip: the firmware's player (motion/), the virtual servos and a body, in one loop.
 * For campaigns and searches, where the simulated ATmega128 would cost most of the time. It leaves out the wire (goals
 * reach the servos 1/1024 s after their tick, as with a SYNC WRITE to 18 joints), the console, the approach and the
 * servo replies. Slopes come from the pages, as the firmware sends them. Single-threaded; any number may exist. */
#ifndef SIM_QUICK_H
#define SIM_QUICK_H

#include "player.h"
#include "servo_bus.h"

#define QUICK_IMAGE_BYTES (PAGE_COUNT * PAGE_BYTES)

typedef struct quick quick_t;

/* Load of a servo since the start of a play. */
typedef struct {
    double torque_nm;    /* mean absolute torque of the motor */
    double torque2_nm2;  /* mean square torque, which determines the heat */
    double most_degrees_c;
    double most_units_per_tick; /* fastest change of the goal */
} quick_load_t;

/* Makes a robot without servos. image: QUICK_IMAGE_BYTES as in flash; it is copied. NULL: out of memory. */
quick_t *quick_new(const uint8_t *image);
void quick_free(quick_t *quick);

/* Add servos with servo_bus_add(), connect them to a body with servo_bus_body(). */
servo_bus_t *quick_bus(quick_t *quick);
uint64_t quick_now(const quick_t *quick);

/* Switches torque on with each goal at the present position, as the robot does before a play. */
void quick_torque_on(quick_t *quick);

/* Starts a play from the present goals of the joints and resets the loads. Returns player_status_t. */
int quick_start(quick_t *quick, uint8_t page, int law);

/* Uses a copy of `shape` from the next planned step on (shape.h). */
void quick_shape(quick_t *quick, const shape_t *shape);

/* Holds these keys of the remote from now on. 0: released, 255: stop. */
void quick_keys(quick_t *quick, uint8_t code);

/* Runs this many ticks. Returns true during a play. */
bool quick_run(quick_t *quick, uint32_t ticks);

/* The page and step being played (0, 0: none), and the fault that ended the play (page_status_t). */
int quick_page(const quick_t *quick);
int quick_step(const quick_t *quick);
int quick_fault(const quick_t *quick);

/* The goal of a joint, 0..1023. */
int quick_goal(const quick_t *quick, uint8_t joint);

/* Load of the servo with this index, in the order of servo_bus_add(). */
quick_load_t quick_load(const quick_t *quick, int index);

#endif
