/* SPDX-License-Identifier: MIT
 * servo_body.h - the interface to a body that the shafts of all servos move.
 * Without a body, each servo turns its own rotor (servo_motion.h). With one, the bus steps it 1024 times a second on
 * the absolute time axis: servos give torques, the body returns shaft angles. Knows no physics engine. */
#ifndef SIM_SERVO_BODY_H
#define SIM_SERVO_BODY_H

#include <stdint.h>

#define SERVO_STEP_CYCLES 15625u /* 1/1024 s; a tick of the firmware has eight */

/* One shaft. It has only doubles, so that a binding sees an array of numbers. Torque, angle and speed are positive
 * towards larger servo positions. Angle 0 is position 512. */
typedef struct {
    double id; /* the servo's ID when it was added: its place in the body, even if its table changes */
    double torque_nm;
    double angle_rad, speed_rad_s;
} servo_shaft_t;

/* Both calls get one shaft for each servo, in the order of servo_bus_add(). */
typedef struct servo_body {
    void *context;
    /* Returns the present angle and speed. Angle NAN: the body has no joint for this servo, which turns its own rotor. */
    void (*look)(void *context, servo_shaft_t *shafts, int count);
    /* Simulates 1/1024 s under these torques and returns angle and speed after it. */
    void (*step)(void *context, servo_shaft_t *shafts, int count);
} servo_body_t;

#endif
