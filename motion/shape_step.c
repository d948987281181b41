/* SPDX-License-Identifier: MIT
 * shape_step.c - blend, amplitude and clamp of a step's position words (shaping.md). One rounding, at the end:
 *
 *   p2 = c + A (p + W (q - p) - c)        as c + d / 10000,  d = A |100 p1 - 100 c|,  100 p1 = (100 - W) p + W q in percents
 *
 * Rounded half away from c, so that a mirrored motion stays mirrored. A joint without a centre is not scaled; c is p then.
 * Ranges: 100 p1, 100 c <= 102,300; d <= 150 * 102,300 = 15,345,000. */
#include "shape_step.h"
#include "fix.h"

#define WHOLE 10000u

static void read_header(const page_source_t *source, uint8_t page, uint8_t at, uint8_t *to, uint8_t count)
{
    source->read(source->context, page, at, to, count);
}

/* The number of steps of a page; 0 if there is no such page or it is damaged. */
static NOINLINE uint8_t steps_of(const page_source_t *source, uint8_t page)
{
    uint8_t steps;
    if (page == 0 || page >= PAGE_COUNT || source->check(source->context, page) != PAGE_OK) {
        return 0;
    }
    read_header(source, page, PAGE_AT_STEPS, &steps, 1);
    return steps;
}

/* The page that `page` is blended with; 0: none, or it has another number of steps. */
static uint8_t partner_of(const shape_t *shape, const page_source_t *source, uint8_t page)
{
    uint8_t header[PAGE_AT_STEPS + 1u - PAGE_AT_BLEND_RIGHT];
    read_header(source, page, PAGE_AT_BLEND_RIGHT, header, sizeof header);
    uint8_t partner = header[shape->blend_percent > 0 ? 0 : PAGE_AT_BLEND_LEFT - PAGE_AT_BLEND_RIGHT];
    if (shape->blend_percent == 0 || steps_of(source, partner) != header[sizeof header - 1u]) {
        partner = 0;
    }
    return partner;
}

/* Reads the words of a share of joints from `first` on. In page 0 no joint is used. */
static NOINLINE void read_share(const page_source_t *source, uint8_t page, uint8_t step, uint8_t first,
                                uint16_t words[SHAPE_STEP_SHARE])
{
    if (page == 0) {
        memset(words, PAGE_POS_UNUSED >> 8, 2u * SHAPE_STEP_SHARE);
    } else {
        uint8_t count = PAGE_JOINTS - first;
        count = count < SHAPE_STEP_SHARE ? count : SHAPE_STEP_SHARE;
        source->read(source->context, page, (uint16_t)(PAGE_STEP_BYTES * step + 2u * first), words, (uint8_t)(2u * count));
    }
}

/* size / 10000, halves up; size up to 15,345,000. By the reciprocal of 10000 / 256, 2^16 / 39.0625 = 1677.7 rounded down: at
 * most one too small. A division of 32 bits takes 650 cycles. */
static uint16_t round_to_whole(uint32_t size)
{
    size += WHOLE / 2;
    uint16_t quotient = mul_u16_high((uint16_t)(size >> 8), 1677u);
    uint16_t rest = (uint16_t)((uint16_t)size - (uint16_t)(quotient * WHOLE)); /* below 2 * WHOLE: 16 bits will do */
    return rest >= WHOLE ? (uint16_t)(quotient + 1u) : quotient;
}

static uint16_t shaped(uint16_t p, uint16_t q, uint16_t c, uint8_t amplitude, uint8_t blend)
{
    uint32_t hundredths = mul_u16_u8(p, (uint8_t)(100u - blend)) + mul_u16_u8(q, blend);
    uint32_t way = hundredths - mul_u16_u8(c, 100u);
    const bool down = (int32_t)way < 0;
    if (down) {
        way = 0 - way;
    }
    uint32_t size = mul_u16_u8((uint16_t)way, amplitude);
    if ((uint8_t)(way >> 16) != 0) { /* it has 17 bits */
        size += (uint32_t)amplitude << 16;
    }
    uint16_t whole = round_to_whole(size);
    if (down) {
        return whole > c ? 0 : (uint16_t)(c - whole);
    }
    uint16_t pos = (uint16_t)(c + whole);
    return pos > PAGE_POS_MAX ? PAGE_POS_MAX : pos;
}

bool shape_step_begin(shape_step_t *shaping, const shape_t *shape, const page_source_t *source, uint8_t page, uint8_t step)
{
    shaping->partner = partner_of(shape, source, page);
    shaping->centre = steps_of(source, shape->centre_page) != 0 ? shape->centre_page : 0;
    shaping->step = step;
    shaping->blend_percent = (uint8_t)(shape->blend_percent < 0 ? -shape->blend_percent : shape->blend_percent);
    shaping->done = 0;
    memcpy(shaping->amplitude_percent, shape->amplitude_percent, sizeof shaping->amplitude_percent);
    return shaping->partner != 0 || shape->scales;
}

void shape_step_share(shape_step_t *shaping, const page_source_t *source, uint16_t words[PAGE_JOINTS])
{
    uint16_t partner[SHAPE_STEP_SHARE], centre[SHAPE_STEP_SHARE];
    uint8_t joint = shaping->done;
    read_share(source, shaping->partner, shaping->step, joint, partner);
    read_share(source, shaping->centre, 1, joint, centre);
    uint16_t *word = &words[joint];
    for (uint8_t i = 0; i < SHAPE_STEP_SHARE && joint < PAGE_JOINTS; i++, joint++, word++) {
        uint16_t p = *word, q = partner[i], c = centre[i];
        bool scales = page_pos_is_used(c), blends = page_pos_is_used(q);
        if (page_pos_is_used(p) && (scales || blends)) {
            uint8_t amplitude = scales ? shaping->amplitude_percent[joint] : SHAPE_NORMAL;
            *word = shaped(p, blends ? q : p, scales ? c : p, amplitude, shaping->blend_percent);
        }
    }
    shaping->done = joint;
}
