/* SPDX-License-Identifier: MIT */
#include "code_motion.h"

#include <stddef.h>
#include "mul.h"
#include "page.h"

void code_motion_init(code_motion_t *code)
{
    code->joints = 0;
    for (uint8_t i = 0; i < CODE_MOTION_JOINTS; i++) {
        code->slot[i].joint = CODE_MOTION_NO_JOINT;
    }
}

code_slot_t *code_motion_slot(code_motion_t *code, uint8_t joint)
{
    code_slot_t *found = NULL;
    for (uint8_t i = 0; i < CODE_MOTION_JOINTS; i++) {
        code_slot_t *slot = &code->slot[i];
        if (slot->joint == joint) {
            return slot;
        }
        if (slot->joint == CODE_MOTION_NO_JOINT) {
            found = slot;
        }
    }
    return found;
}

void code_motion_take(code_motion_t *code, code_slot_t *slot, uint8_t joint, uint16_t speed_q8_8)
{
    code->joints |= (uint32_t)1 << joint;
    *slot = (code_slot_t){.joint = joint, .speed = {.speed_q8_8 = speed_q8_8}};
}

void code_motion_free(code_motion_t *code, uint32_t joints)
{
    for (uint8_t i = 0; i < CODE_MOTION_JOINTS; i++) {
        code_slot_t *slot = &code->slot[i];
        if (slot->joint != CODE_MOTION_NO_JOINT && (joints >> slot->joint & 1u) != 0) {
            slot->joint = CODE_MOTION_NO_JOINT;
        }
    }
    code->joints &= ~joints;
}

bool code_motion_can_swing(uint16_t centre, uint16_t amplitude, uint16_t period_ticks)
{
    if (centre > PAGE_POS_MAX || amplitude > centre || amplitude > PAGE_POS_MAX - centre ||
        period_ticks < CODE_MOTION_PERIOD_MIN_TICKS) {
        return false;
    }
    return (uint32_t)amplitude * 44u <= (uint32_t)period_ticks * (7u * CODE_MOTION_SPEED_MAX); /* 2 pi A / T */
}

void code_motion_swing(code_slot_t *slot, uint16_t centre, uint16_t amplitude, uint16_t period_ticks, uint16_t phase_deg)
{
    slot->centre_pos = centre;
    slot->amplitude_pos = amplitude;
    slot->phase_step = UINT32_MAX / period_ticks;
    slot->phase = (UINT32_MAX / 360u) * phase_deg;
}

bool code_motion_swings(const code_motion_t *code)
{
    bool swings = false;
    for (uint8_t i = 0; i < CODE_MOTION_JOINTS; i++) {
        swings |= code->slot[i].joint != CODE_MOTION_NO_JOINT && code->slot[i].amplitude_pos != 0;
    }
    return swings;
}

/* Size of the sine of a phase, 0..65535: y = 4 x (1 - x) of the half turn x, then y (0.775 + 0.225 y). */
static uint16_t sine_size(uint32_t phase)
{
    const uint16_t x = (uint16_t)((phase << 1) >> 16);
    const uint16_t quarter = mul_u16_high(x, (uint16_t)(0u - x)); /* up to 2^14 */
    const uint16_t y = (uint16_t)(quarter >> 14 == 0 ? quarter << 2 : UINT16_MAX);
    return mul_u16_high(y, (uint16_t)(mul_u16_high(y, 14746u) + 50790u));
}

uint16_t code_motion_tick(code_slot_t *slot)
{
    const uint32_t phase = slot->phase;
    const uint16_t size = (uint16_t)((mul_u16_u16(slot->amplitude_pos, sine_size(phase)) + 0x8000u) >> 16);
    slot->phase = phase + slot->phase_step;
    return (phase & 0x80000000u) != 0 ? (uint16_t)(slot->centre_pos - size) : (uint16_t)(slot->centre_pos + size);
}
