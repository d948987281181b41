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
