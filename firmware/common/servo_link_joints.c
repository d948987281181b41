/* SPDX-License-Identifier: MIT
 * servo_link_joints.c - which joints can be driven, and their coordinates. */
#include "servo_link_parts.h"

#include <stddef.h>
#include <string.h>

void servo_link_init(servo_link_t *link)
{
    memset(link, 0, sizeof *link);
    memset(link->present_pos, 0xFF, sizeof link->present_pos);
}

uint8_t servo_link_take_lowest(uint32_t *mask)
{
    const uint8_t id = servo_link_lowest(mask);
    servo_link_put(mask, id, false);
    return id;
}

uint32_t servo_link_drivable(const servo_link_t *link)
{
    return link->present & link->torque & ~link->silent;
}

/* ---- coordinates ---- */

NOINLINE uint16_t servo_link_to_servo(const servo_link_t *link, uint8_t id, uint16_t pos)
{
    return limited((uint16_t)(pos + (uint16_t)link->trim_pos[id]));
}

NOINLINE uint16_t servo_link_to_page(const servo_link_t *link, uint8_t id, uint16_t servo_pos)
{
    return limited((uint16_t)(servo_pos - (uint16_t)link->trim_pos[id]));
}

uint32_t servo_link_set_trim(servo_link_t *link, const int16_t trim_pos[SERVO_LINK_JOINTS])
{
    uint32_t refused = 0;
    memset(link->present_pos, 0xFF, sizeof link->present_pos);
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        int16_t trim = trim_pos == NULL ? 0 : trim_pos[id];
        if (trim > SERVO_LINK_TRIM_MAX || trim < -SERVO_LINK_TRIM_MAX) {
            refused |= servo_link_bit(id);
            trim = 0;
        }
        link->trim_pos[id] = trim;
    }
    return refused;
}
