/* SPDX-License-Identifier: MIT
 * servo_link_masks.c - masks of joints: a bit for each servo ID. */
#include "servo_link.h"

uint32_t servo_link_bit(uint8_t id)
{
    return SERVO_LINK_BIT(id);
}

bool servo_link_has(const uint32_t *mask, uint8_t id)
{
    return (*mask & servo_link_bit(id)) != 0;
}

void servo_link_put(uint32_t *mask, uint8_t id, bool on)
{
    const uint32_t bit = servo_link_bit(id);
    *mask = on ? *mask | bit : *mask & ~bit;
}

uint8_t servo_link_lowest(const uint32_t *mask)
{
    uint8_t id = 0;
    while (!servo_link_has(mask, id)) {
        id++;
    }
    return id;
}
