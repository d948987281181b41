/* SPDX-License-Identifier: MIT */
#include "fake_servo_link.h"

#include <string.h>
#include "page.h"

#define FAULTS 8u

fake_servo_link_t fake_servo_link;
static servo_fault_t faults[FAULTS];
static uint8_t fault_count;

void fake_servo_link_reset(servo_link_t *link, uint32_t present)
{
    memset(link, 0, sizeof *link);
    memset(&fake_servo_link, 0, sizeof fake_servo_link);
    fault_count = 0;
    link->present = present;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        fake_servo_link.goal_pos[id] = 0xFFFF;
        fake_servo_link.pose_pos[id] = 512;
        link->present_pos[id] = SERVO_LINK_NO_POSE;
    }
}

void fake_servo_link_fault(servo_link_t *link, uint8_t id, uint8_t kind, uint8_t errors)
{
    if (kind == SERVO_FAULT_SILENT) {
        link->silent |= SERVO_LINK_BIT(id);
    } else if (kind == SERVO_FAULT_BACK) {
        link->silent &= ~SERVO_LINK_BIT(id);
    }
    faults[fault_count++] = (servo_fault_t){.id = id, .kind = kind, .errors = errors};
}

uint16_t servo_link_limited(uint16_t pos)
{
    return (int16_t)pos < 0 ? 0 : pos > PAGE_POS_MAX ? PAGE_POS_MAX : pos;
}

bool servo_link_next_fault(servo_link_t *link, servo_fault_t *fault)
{
    (void)link;
    if (fault_count == 0) {
        return false;
    }
    *fault = faults[0];
    memmove(faults, faults + 1, sizeof faults - sizeof faults[0]);
    fault_count--;
    return true;
}

uint32_t servo_link_read_pose(servo_link_t *link, uint32_t ids)
{
    const uint32_t answering = ids & link->present & ~link->silent & ~fake_servo_link.mute;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if ((answering & SERVO_LINK_BIT(id)) != 0) {
            link->present_pos[id] = servo_link_limited(fake_servo_link.pose_pos[id]);
        }
    }
    return answering;
}

uint32_t servo_link_torque_on(servo_link_t *link, uint32_t ids)
{
    const uint32_t on = servo_link_read_pose(link, ids);
    link->torque |= on;
    return on;
}

uint32_t servo_link_torque_off(servo_link_t *link, uint32_t ids)
{
    link->torque &= ~ids;
    return ids & link->present & ~link->silent;
}

uint32_t servo_link_drivable(const servo_link_t *link)
{
    return link->present & ~link->silent & link->torque;
}

void servo_link_goals(servo_link_t *link, const uint16_t goal_pos[SERVO_LINK_JOINTS], uint32_t joints)
{
    joints &= servo_link_drivable(link);
    fake_servo_link.joints = joints;
    fake_servo_link.frames++;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if ((joints & SERVO_LINK_BIT(id)) != 0) {
            fake_servo_link.goal_pos[id] = goal_pos[id];
            fake_servo_link.pose_pos[id] = goal_pos[id];
        }
    }
}

void servo_link_slopes(servo_link_t *link, const uint8_t compliance[SERVO_LINK_JOINTS])
{
    (void)link;
    fake_servo_link.slopes++;
    memcpy(fake_servo_link.compliance, compliance, sizeof fake_servo_link.compliance);
}

bool servo_link_engage(servo_link_t *link, uint8_t id, uint16_t *pos)
{
    fake_servo_link.engagements++;
    *pos = fake_servo_link.pose_pos[id];
    return servo_link_torque_on(link, SERVO_LINK_BIT(id)) != 0;
}

void servo_link_poll(servo_link_t *link)
{
    (void)link;
}

void servo_link_tick(servo_link_t *link)
{
    (void)link;
    fake_servo_link.ticks++;
}
