/* SPDX-License-Identifier: MIT */
#include "negative.h"

static void NOINLINE set_clock(void)
{
    XDIV = WRONG ? 0x80 : 0;
}

int main(void)
{
    console_on();
    set_clock();
    finish();
}
