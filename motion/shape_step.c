/* SPDX-License-Identifier: MIT
 * shape_step.c - blend, amplitude and clamp of a step's position words (shaping.md). One rounding, at the end:
 *
 *   p2 = c + A (p + W (q - p) - c)        as c + d / 10000,  d = A (100 (p - c) + W (q - p)) in percents
 *
 * Rounded half away from c, so that a mirrored motion stays mirrored. A joint without a centre is not scaled; c is p then.
 * Ranges: |p - c|, |q - p| <= 1023, so |d| <= 150 * (100 + 100) * 1023 = 30,690,000. */
#include "shape_step.h"
#include "mul.h"

#define NO_POS PAGE_POS_UNUSED
#define WHOLE 10000u
#define AT_ONCE 8u /* joints: the stack has no room for three whole steps */

static uint8_t header_byte(const page_source_t *source, uint8_t page, uint8_t at)
{
    uint8_t byte;
    source->read(source->context, page, at, &byte, 1);
    return byte;
}

/* The page that `page` is blended with; 0: none, or not one of the same number of steps. */
static uint8_t partner_of(const shape_t *shape, const page_source_t *source, uint8_t page)
{
    uint8_t at = shape->blend_percent > 0 ? PAGE_AT_BLEND_RIGHT : PAGE_AT_BLEND_LEFT;
    uint8_t partner = shape->blend_percent == 0 ? 0 : header_byte(source, page, at);
    if (partner == 0 || partner >= PAGE_COUNT || source->check(source->context, partner) != PAGE_OK ||
        header_byte(source, partner, PAGE_AT_STEPS) != header_byte(source, page, PAGE_AT_STEPS)) {
        return 0;
    }
    return partner;
}

/* The page of the centre pose; 0: there is none. */
static uint8_t centre_of(const shape_t *shape, const page_source_t *source)
{
    uint8_t page = shape->centre_page;
    if (page != 0 && (source->check(source->context, page) != PAGE_OK || header_byte(source, page, PAGE_AT_STEPS) == 0)) {
        page = 0;
    }
    return page;
}

/* Positions of AT_ONCE joints from `first` on in a step of a page, NO_POS where there is none; page 0 has none. (Behind
 * joint
 * 30 stand pause and time.) */
static void read_positions(const page_source_t *source, uint8_t page, uint8_t step, uint8_t first, uint16_t pos[AT_ONCE])
{
    if (page != 0) {
        source->read(source->context, page, (uint16_t)(PAGE_STEP_BYTES * step + 2u * first), pos, 2u * AT_ONCE);
    }
    for (uint8_t i = 0; i < AT_ONCE; i++) {
        if (page == 0 || !page_pos_is_used(pos[i])) {
            pos[i] = NO_POS;
        }
    }
}

/* size / 10000, halves up; size up to 30,690,000. By the reciprocal, 2^24 / 10000 = 1677.7 rounded down: at most two too
 * small.
 * A division of 32 bits takes 650 cycles, and there are 31 of these in a tick. */
static uint16_t round_to_whole(uint32_t size)
{
    size += WHOLE / 2;
    uint16_t quotient = (uint16_t)(mul_u32_u16_shift16(size, 1677u) >> 8);
    uint32_t rest = size - mul_u16_u16(quotient, WHOLE);
    for (; rest >= WHOLE; rest -= WHOLE) {
        quotient++;
    }
    return quotient;
}

/* way * percent; |way| <= 1023, percent up to 15,000. */
static int32_t part_of_way(int16_t way, uint16_t percent)
{
    int32_t size = (int32_t)mul_u16_u16((uint16_t)(way < 0 ? -way : way), percent);
    return way < 0 ? -size : size;
}

/* way * percent / 100, halves up: round_to_whole(way * percent * 100), at half its cycles. (n / 4) / 25 is n / 100, and
 * 41944 is 2^20 / 25 rounded up, exact up to 38,375. */
static uint16_t scaled(uint16_t way, uint8_t percent)
{
    uint32_t hundredths = mul_u16_u16(way, percent) + 50u;
    return mul_u16_high((uint16_t)(hundredths >> 2), 41944u) >> 4;
}

static uint16_t shaped(uint16_t p, uint16_t q, uint16_t c, uint8_t amplitude, uint8_t blend)
{
    bool down = p < c;
    int16_t whole;
    if (q == p) {
        whole = (int16_t)scaled((uint16_t)(down ? c - p : p - c), amplitude);
    } else {
        int32_t way = part_of_way((int16_t)(p - c), (uint16_t)(amplitude * 100u)) +
                      part_of_way((int16_t)(q - p), (uint16_t)(amplitude * blend));
        down = way < 0;
        whole = (int16_t)round_to_whole((uint32_t)(down ? -way : way));
    }
    int16_t pos = (int16_t)((int16_t)c + (down ? -whole : whole));
    return pos < 0 ? 0 : pos > (int16_t)PAGE_POS_MAX ? PAGE_POS_MAX : (uint16_t)pos;
}

void shape_step(const shape_t *shape, const page_source_t *source, uint8_t page, uint8_t step,
                uint8_t bytes[PAGE_STEP_BYTES])
{
    uint8_t partner = partner_of(shape, source, page);
    if (partner == 0 && !shape->scales) {
        return;
    }
    uint8_t centre = centre_of(shape, source);
    uint8_t blend = (uint8_t)(shape->blend_percent < 0 ? -shape->blend_percent : shape->blend_percent);
    uint16_t partner_pos[AT_ONCE], centre_pos[AT_ONCE];
    for (uint8_t i = 0; i < PAGE_JOINTS; i++, bytes += 2) {
        uint8_t at = i % AT_ONCE;
        if (at == 0) {
            read_positions(source, partner, step, i, partner_pos);
            read_positions(source, centre, 1, i, centre_pos);
        }
        uint16_t p = page_word(bytes), q = partner_pos[at], c = centre_pos[at];
        if (page_pos_is_used(p) && (q != NO_POS || c != NO_POS)) {
            uint8_t amplitude = c != NO_POS ? shape->amplitude_percent[i] : SHAPE_NORMAL;
            uint16_t pos = shaped(p, q != NO_POS ? q : p, c != NO_POS ? c : p, amplitude, blend);
            bytes[0] = (uint8_t)pos;
            bytes[1] = (uint8_t)(pos >> 8);
        }
    }
}
