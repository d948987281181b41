/* SPDX-License-Identifier: MIT
 * shape_step.c - blend, amplitude and clamp of a step's position words (SHAPING.md). It rounds once, at the end:
 *
 *   p2 = c + A (p + W (q - p) - c)        as c + d / 10000,  d = A |100 p1 - 100 c|,  100 p1 = (100 - W) p + W q in percents
 *
 * Halves are rounded away from c, so that a mirrored motion stays mirrored. A joint without a centre is not scaled: c is p.
 * Ranges: 100 p1, 100 c <= 102,300; d <= 150 * 102,300 = 15,345,000. */
#include "shape_step.h"
#include "compiler.h"
#include "mul.h"

#define WHOLE 10000u
#define AT_ONCE 8u /* joints whose words are read together: 32 bytes of stack */

uint8_t shape_steps_of(const page_source_t *source, uint8_t page)
{
    uint8_t steps;
    if (page == 0 || !page_is_there(page) || source->check(source->context, page) != PAGE_OK) {
        return 0;
    }
    source->read(source->context, page, PAGE_AT_STEPS, &steps, 1);
    return steps;
}

/* The page that `page` is blended with; 0: none, or it has another number of steps. */
static uint8_t partner_of(const shape_t *shape, const page_source_t *source, uint8_t page)
{
    uint8_t header[PAGE_AT_STEPS + 1u - PAGE_AT_BLEND_RIGHT];
    source->read(source->context, page, PAGE_AT_BLEND_RIGHT, header, sizeof header);
    const uint8_t partner = header[shape->blend_percent > 0 ? 0 : PAGE_AT_BLEND_LEFT - PAGE_AT_BLEND_RIGHT];
    return shape_steps_of(source, partner) == header[sizeof header - 1u] ? partner : 0;
}

/* Reads the words of some joints. In page 0 no joint is used. */
static void read_some(const page_source_t *source, uint8_t page, uint8_t step, uint8_t first, uint8_t count,
                      uint16_t words[AT_ONCE])
{
    if (page == 0) {
        memset(words, PAGE_POS_UNUSED >> 8, 2u * AT_ONCE);
    } else {
        source->read(source->context, page, (uint16_t)(PAGE_STEP_BYTES * step + 2u * first), words, (uint8_t)(2u * count));
    }
}

/* size / 10000, halves up; size up to 15,345,000. By the reciprocal of 10000 / 256, 2^16 / 39.0625 = 1677.7 rounded down: at
 * most one too small. A division of 32 bits takes 650 cycles. */
static uint16_t round_to_whole(uint32_t size)
{
    size += WHOLE / 2;
    uint16_t quotient = mul_u16_high((uint16_t)(size >> 8), 1677u);
    uint16_t left = (uint16_t)((uint16_t)size - (uint16_t)(quotient * WHOLE)); /* below 2 * WHOLE */
    return left >= WHOLE ? (uint16_t)(quotient + 1u) : quotient;
}

static uint16_t shaped(uint16_t p, uint16_t q, uint16_t c, uint8_t amplitude, uint8_t blend)
{
    uint32_t hundredths = mul_u16_u8(p, (uint8_t)(100u - blend)) + mul_u16_u8(q, blend);
    uint32_t distance = hundredths - mul_u16_u8(c, 100u);
    const bool down = (int32_t)distance < 0;
    if (down) {
        distance = 0 - distance;
    }
    uint32_t size = mul_u16_u8((uint16_t)distance, amplitude);
    if ((uint8_t)(distance >> 16) != 0) { /* distance has 17 bits */
        size += (uint32_t)amplitude << 16;
    }
    uint16_t whole = round_to_whole(size);
    if (down) {
        return whole > c ? 0 : (uint16_t)(c - whole);
    }
    uint16_t pos = (uint16_t)(c + whole);
    return pos > PAGE_POS_MAX ? PAGE_POS_MAX : pos;
}

/* Where the words that shape a step come from. */
typedef struct {
    uint8_t partner, centre; /* pages; 0: none */
    uint8_t blend;           /* 0..100, toward the partner */
} sources_t;

/* NOINLINE: see decide() in sequence.c. */
static NOINLINE void shape_words(const shape_t *shape, const page_source_t *source, const sources_t *from, uint8_t step,
                                 uint16_t words[PAGE_JOINTS])
{
    uint16_t of_partner[AT_ONCE], of_centre[AT_ONCE];
    uint8_t at = AT_ONCE;
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++, at++) {
        if (at == AT_ONCE) {
            const uint8_t left = (uint8_t)(PAGE_JOINTS - joint), count = left < AT_ONCE ? left : AT_ONCE;
            read_some(source, from->partner, step, joint, count, of_partner);
            read_some(source, from->centre, 1, joint, count, of_centre);
            at = 0;
        }
        const uint16_t p = words[joint], q = of_partner[at], c = of_centre[at];
        const bool blends = page_pos_is_used(q), scales = page_pos_is_used(c);
        if (page_pos_is_used(p) && (blends || scales)) {
            const uint8_t amplitude = scales ? shape->amplitude_percent[joint] : SHAPE_NORMAL;
            words[joint] = shaped(p, blends ? q : p, scales ? c : p, amplitude, from->blend);
        }
    }
}

void shape_step(const shape_t *shape, const page_source_t *source, uint8_t page, uint8_t step, uint16_t words[PAGE_JOINTS])
{
    const int8_t blend = shape->blend_percent;
    const sources_t from = {.partner = blend != 0 ? partner_of(shape, source, page) : 0,
                            .centre = shape_steps_of(source, shape->centre_page) != 0 ? shape->centre_page : 0,
                            .blend = (uint8_t)(blend < 0 ? -blend : blend)};
    if (from.partner != 0 || shape->scales) {
        shape_words(shape, source, &from, step, words);
    }
}
