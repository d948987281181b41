/* SPDX-License-Identifier: MIT
 * layers_code.c - code-made motion: aim and swing. */
#include "layers_parts.h"

#include <string.h>

static NOINLINE uint32_t bit_of(uint8_t joint)
{
    return (uint32_t)1 << joint;
}

/* --- slots ------------------------------------------------------------------------------------------------------- */

static NOINLINE layers_code_t *slot_of(layers_t *layers, uint8_t joint)
{
    for (uint8_t i = 0; i < LAYERS_CODE_JOINTS; i++) {
        if (layers->code[i].joint == joint) {
            return &layers->code[i];
        }
    }
    return NULL;
}

void layers_forget_code(layers_t *layers)
{
    layers->code_joints = 0;
    for (uint8_t i = 0; i < LAYERS_CODE_JOINTS; i++) {
        layers->code[i].joint = LAYERS_NO_JOINT;
    }
}

/* --- aim, swing, free --------------------------------------------------------------------------------------------- */

static layers_code_t *free_slot(layers_t *layers, uint8_t id)
{
    layers_code_t *slot = slot_of(layers, id);
    return slot != NULL ? slot : slot_of(layers, LAYERS_NO_JOINT);
}

bool layers_have_room(layers_t *layers, uint8_t id)
{
    return free_slot(layers, id) != NULL;
}

/* A slot for the joint, which now belongs to code. */
static layers_status_t take_for_code(layers_t *layers, uint8_t id, layers_code_t **slot)
{
    player_t *main_play = layers->main;
    if (id >= PAGE_JOINTS) {
        return LAYERS_ERR_JOINTS;
    }
    const uint32_t bit = bit_of(id);
    if (main_play != NULL && player_is_moving(main_play) && (main_play->present & bit) == 0) {
        return LAYERS_ERR_JOINTS;
    }
    *slot = free_slot(layers, id);
    if (*slot == NULL) {
        return LAYERS_ERR_FULL;
    }
    if (main_play != NULL) {
        player_drop_joints(&layers->play, bit);
        main_play->joint[id].owner = PLAYER_OWNER_CODE;
        main_play->lent |= bit;
    }
    layers->code_joints |= bit;
    memset(*slot, 0, sizeof **slot);
    (*slot)->joint = id;
    (*slot)->speed_q8_8 = layers->speed_q8_8;
    return LAYERS_OK;
}

layers_status_t layers_aim(layers_t *layers, uint8_t id, uint16_t pos, uint16_t deg_s)
{
    layers_code_t *slot;
    if (pos > PAGE_POS_MAX || deg_s > LAYERS_SPEED_MAX_DEG_S) {
        return LAYERS_ERR_RANGE;
    }
    layers_status_t status = take_for_code(layers, id, &slot);
    if (status == LAYERS_OK) {
        slot->centre_pos = pos;
        if (deg_s != 0) {
            slot->speed_q8_8 = layers_units_per_tick_q8_8(deg_s);
        }
    }
    return status;
}

bool layers_can_swing(uint16_t centre, uint16_t amplitude, uint16_t period_ticks)
{
    if (centre > PAGE_POS_MAX || amplitude > centre || amplitude > PAGE_POS_MAX - centre ||
        period_ticks < LAYERS_PERIOD_MIN_TICKS) {
        return false;
    }
    return (uint32_t)amplitude * 44u <= (uint32_t)period_ticks * (7u * LAYERS_SWING_SPEED_MAX); /* 2 pi A / T */
}

layers_status_t layers_swing(layers_t *layers, uint8_t id, uint16_t centre, uint16_t amplitude, uint16_t period_ticks,
                             uint16_t phase_deg)
{
    layers_code_t *slot;
    if (phase_deg > 359u || !layers_can_swing(centre, amplitude, period_ticks)) {
        return LAYERS_ERR_RANGE;
    }
    layers_status_t status = take_for_code(layers, id, &slot);
    if (status == LAYERS_OK) {
        slot->centre_pos = centre;
        slot->amplitude_pos = amplitude;
        slot->phase_step = UINT32_MAX / period_ticks;
        slot->phase = (UINT32_MAX / 360u) * phase_deg;
    }
    return status;
}

void layers_free(layers_t *layers, uint32_t joints)
{
    joints &= layers->code_joints;
    layers->code_joints &= ~joints;
    for (uint8_t i = 0; i < LAYERS_CODE_JOINTS; i++) {
        uint8_t joint = layers->code[i].joint;
        if (joint != LAYERS_NO_JOINT && (layers->code_joints & bit_of(joint)) == 0) {
            layers->code[i].joint = LAYERS_NO_JOINT;
        }
    }
    layers_hand_back(layers, joints);
}

/* --- a tick ------------------------------------------------------------------------------------------------------- */

/* sin of a phase, as a size 0..65535: y = 4 x (1 - x) of the half turn x, then y (0.775 + 0.225 y). */
static uint16_t sine_size(uint32_t phase)
{
    uint16_t x = (uint16_t)((phase << 1) >> 16);
    uint16_t quarter = mul_u16_high(x, (uint16_t)(0u - x)); /* up to 2^14 */
    uint16_t y = UINT16_MAX;
    if (quarter >> 14 == 0) {
        y = (uint16_t)(quarter << 2);
    }
    uint16_t slope = mul_u16_high(y, 14746u);
    slope = (uint16_t)(slope + 50790u);
    return mul_u16_high(y, slope);
}

static uint16_t asked_by_code(const layers_code_t *code)
{
    uint16_t way = (uint16_t)((fix_product(code->amplitude_pos, sine_size(code->phase)) + 0x8000u) >> 16);
    bool below = (code->phase & 0x80000000u) != 0;
    return below ? (uint16_t)(code->centre_pos - way) : (uint16_t)(code->centre_pos + way);
}

/* `from`, one tick's way nearer to `to`. */
static uint16_t approach_by(uint16_t from, uint16_t to, uint8_t most)
{
    if (to > from) {
        return to - from > most ? (uint16_t)(from + most) : to;
    }
    return from - to > most ? (uint16_t)(from - most) : to;
}

void layers_move_by_code(layers_t *layers)
{
    for (layers_code_t *code = layers->code; code < &layers->code[LAYERS_CODE_JOINTS]; code++) {
        if (code->joint == LAYERS_NO_JOINT) {
            continue;
        }
        uint16_t *goal = &layers->goal_pos[code->joint], asked = asked_by_code(code);
        if (code->there) {
            *goal = asked;
        } else {
            *goal = approach_by(*goal, asked, layers_allow(&code->allowance_q8_8, code->speed_q8_8));
            code->there = *goal == asked;
        }
        code->phase += code->phase_step;
    }
}
