/* SPDX-License-Identifier: MIT */
#include "shape.h"

void shape_reset(shape_t *shape)
{
    shape->rate_percent = SHAPE_NORMAL;
    shape->blend_percent = 0;
    shape->scales = false;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        shape->amplitude_percent[i] = SHAPE_NORMAL;
    }
}

void shape_init(shape_t *shape)
{
    shape_reset(shape);
    shape->centre_page = SHAPE_CENTRE_DEFAULT;
    shape->top_speed_q4_4 = 0;
}

void shape_set_amplitude(shape_t *shape, uint8_t percent, uint32_t joints)
{
    shape->scales = false;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, joints >>= 1) {
        if (((uint8_t)joints & 1u) != 0) {
            shape->amplitude_percent[i] = percent;
        }
        shape->scales |= shape->amplitude_percent[i] != SHAPE_NORMAL;
    }
}

void shape_set_voltage(shape_t *shape, uint8_t decivolts)
{
    /* 0.9 * 8.7 / 111 * 16 = 1.1287 sixteenths of a unit for each 0.1 V; 289 / 256 = 1.1289 */
    uint16_t top = (uint16_t)(decivolts * 289ul / 256u);
    shape->top_speed_q4_4 = top > UINT8_MAX ? UINT8_MAX : (uint8_t)top;
}
