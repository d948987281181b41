/* SPDX-License-Identifier: MIT */
#include "steer.h"

bool steer_is_possible(const performer_t *performer)
{
    uint8_t partners[2];
    STATIC_ASSERT(PAGE_AT_BLEND_LEFT == PAGE_AT_BLEND_RIGHT + 1, "both partners in one read");
    if (performer_is_idle(performer) || performer->page == 0) {
        return false;
    }
    performer->source->read(performer->source->context, performer->page, PAGE_AT_BLEND_RIGHT, partners, sizeof partners);
    return (partners[0] | partners[1]) != 0;
}

void steer_tick(steer_t *steer, performer_t *performer, int8_t direction)
{
    const int16_t wanted = direction * STEER_FULL;
    if (steer->at == wanted && wanted == 0) {
        return;
    }
    if (steer->at < wanted) {
        steer->at++;
    } else if (steer->at > wanted) {
        steer->at--;
    }
    performer->shape.blend_percent = (int8_t)(steer->at * SHAPE_BLEND_MAX / STEER_FULL);
}
