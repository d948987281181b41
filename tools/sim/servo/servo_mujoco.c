/* SPDX-License-Identifier: MIT */
#include "servo_mujoco.h"

#include <math.h>
#include <stddef.h>

static servo_mujoco_joint_t *joint_of(const servo_mujoco_t *body, const servo_shaft_t *shaft)
{
    for (int i = 0; i < body->count; i++) {
        if (body->joints[i].id == (int32_t)shaft->id) {
            return &body->joints[i];
        }
    }
    return NULL;
}

static void look(void *context, servo_shaft_t *shafts, int count)
{
    const servo_mujoco_t *body = context;
    for (int i = 0; i < count; i++) {
        const servo_mujoco_joint_t *joint = joint_of(body, &shafts[i]);
        if (joint) {
            shafts[i].angle_rad = joint->direction * (*joint->angle - joint->offset_rad);
            shafts[i].speed_rad_s = joint->direction * *joint->speed;
        } else {
            shafts[i].angle_rad = NAN;
        }
    }
}

static void step(void *context, servo_shaft_t *shafts, int count)
{
    const servo_mujoco_t *body = context;
    for (int i = 0; i < count; i++) {
        servo_mujoco_joint_t *joint = joint_of(body, &shafts[i]);
        if (joint) {
            *joint->torque = joint->direction * shafts[i].torque_nm;
        }
    }
    body->mj_step(body->model, body->data);
    look(context, shafts, count);
}

servo_body_t servo_mujoco_body(servo_mujoco_t *body)
{
    return (servo_body_t){.context = body, .look = look, .step = step};
}
