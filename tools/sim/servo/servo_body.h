/* SPDX-License-Identifier: MIT
 * servo_body.h - the seam for a body: what the shafts of all servos hang on.
 * Without one, each servo turns its own rotor (servo_motion.h). With one, the bus steps it 1024 times a second on the
 * absolute time axis: servos say their torques, the body answers where the shafts are then. Knows no physics engine. */
#ifndef SIM_SERVO_BODY_H
#define SIM_SERVO_BODY_H

#include <stdint.h>

#define SERVO_STEP_CYCLES 15625u /* 1/1024 s; eight of them are a tick of the firmware */

/* One shaft. Only doubles, so that a binding sees an array of numbers. Torque, angle and speed are positive towards larger
 * servo positions; angle 0 is position 512. */
typedef struct {
    double id; /* the servo's ID when it was plugged in: its place in the body, whatever its table says now */
    double torque_nm;
    double angle_rad, speed_rad_s;
} servo_shaft_t;

/* Both calls get one shaft for each servo, in order of plugging in. */
typedef struct servo_body {
    void *context;
    /* Tells angle and speed as they are. */
    void (*look)(void *context, servo_shaft_t *shafts, int count);
    /* Lets 1/1024 s pass under these torques, and tells angle and speed after it. */
    void (*step)(void *context, servo_shaft_t *shafts, int count);
} servo_body_t;

#endif
