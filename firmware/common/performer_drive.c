/* SPDX-License-Identifier: MIT
 * performer_drive.c - a program drives the play; when it falls silent, the play stops. */
#include "performer_shape.h"

bool performer_drive(performer_t *performer, int16_t blend, uint16_t rate, uint16_t amplitude)
{
    shape_t *shape = &performer->shape;
    const int8_t blend_before = shape->blend_percent;
    const uint16_t rate_before = shape->rate_percent;
    if (shape_set_blend(shape, blend) != SHAPE_OK || shape_set_rate(shape, rate) != SHAPE_OK ||
        shape_set_amplitude(shape, amplitude, SERVO_LINK_ALL) != SHAPE_OK) {
        shape->blend_percent = blend_before;
        shape->rate_percent = rate_before;
        return false;
    }
    /* Tenths of a second. */
    performer->drive_left_ticks = (uint16_t)(performer->settings->drive_ds * (PLAYER_TICKS_PER_SECOND / 2) / 5);
    performer->is_driven = true;
    return true;
}

bool performer_drive_is_lost(performer_t *performer)
{
    return performer->drive_left_ticks != 0 && --performer->drive_left_ticks == 0;
}

void performer_drive_end(performer_t *performer)
{
    if (performer->is_driven) {
        shape_reset(&performer->shape);
    }
    performer->is_driven = false;
    performer->drive_left_ticks = 0;
}

void performer_shape_follow(performer_t *performer)
{
    const uint8_t now_dv = performer->servos->voltage_dv;
    (void)!shape_set_centre(&performer->shape, performer->settings->centre_page);
    if (now_dv != performer->shape_voltage_dv) {
        performer->shape_voltage_dv = now_dv;
        shape_set_voltage(&performer->shape, now_dv);
    }
}
