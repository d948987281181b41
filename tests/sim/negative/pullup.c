/* SPDX-License-Identifier: MIT */
#include "negative.h"

static uint8_t NOINLINE read_buttons(void)
{
    if (!WRONG) {
        PORTE |= 0xF0;
    }
    return PINE & 0xF0;
}

int main(void)
{
    console_on();
    put(read_buttons() == 0xF0 ? '+' : '-');
    finish();
}
