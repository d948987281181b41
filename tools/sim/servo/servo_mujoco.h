/* SPDX-License-Identifier: MIT
 * servo_mujoco.h - a MuJoCo model as the servos' body. Needs no MuJoCo header: the owner of the model (Python) passes
 * the addresses of mj_step and the arrays, and keeps them alive. The model's time step must be 1/1024 s. */
#ifndef SIM_SERVO_MUJOCO_H
#define SIM_SERVO_MUJOCO_H

#include "servo_body.h"

/* One joint with a servo. */
typedef struct {
    double *angle, *speed, *torque; /* places in qpos, qvel and ctrl */
    double direction;               /* +1 or -1: shaft = direction * joint */
    double offset_rad;              /* the joint's angle at shaft angle 0: zero error of the servo */
    int32_t id;                     /* ID of the servo that moves it */
} servo_mujoco_joint_t;

typedef struct {
    void (*mj_step)(const void *model, void *data);
    const void *model;
    void *data;
    servo_mujoco_joint_t *joints;
    int32_t count;
} servo_mujoco_t;

/* Returns the interface to the body. A servo without a joint turns its own rotor. A joint without a servo is limp. */
servo_body_t servo_mujoco_body(servo_mujoco_t *body);

#endif
