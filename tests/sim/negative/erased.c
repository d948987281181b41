/* SPDX-License-Identifier: MIT */
#include "negative.h"

static void NOINLINE jump_away(void)
{
    ((void (*)(void))(0x8000u / 2))();
}

int main(void)
{
    console_on();
    if (WRONG) {
        jump_away();
    }
    finish();
}
