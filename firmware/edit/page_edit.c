/* SPDX-License-Identifier: MIT */
#include "page_edit.h"

#include "page.h"

uint16_t page_edit_mirrored(uint16_t pos, uint16_t neutral_sum)
{
    if (pos >= neutral_sum) {
        return 0;
    }
    uint16_t mirrored = (uint16_t)(neutral_sum - pos);
    return mirrored > PAGE_POS_MAX ? PAGE_POS_MAX : mirrored;
}

uint16_t page_edit_part(uint16_t value, uint16_t mul, uint16_t div)
{
    return (uint16_t)(((uint32_t)value * mul + div / 2u) / div);
}

static uint16_t share_of(uint16_t whole, uint8_t percent)
{
    return page_edit_part(whole, percent, 100);
}

uint16_t page_edit_between(uint16_t a, uint16_t b, uint8_t percent)
{
    const uint16_t distance = share_of((uint16_t)(b > a ? b - a : a - b), percent);
    return (uint16_t)(b > a ? a + distance : a - distance);
}

uint8_t page_edit_time_split(uint8_t *time, uint8_t percent)
{
    uint8_t part = (uint8_t)share_of(*time, percent);
    if (*time == 0) {
        return 0;
    }
    part = part == 0 ? 1 : part;
    *time = *time > part ? (uint8_t)(*time - part) : 1;
    return part;
}
