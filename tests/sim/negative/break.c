/* SPDX-License-Identifier: MIT */
#include "negative.h"

static void NOINLINE stop_here(void)
{
    if (WRONG) {
        __asm__ volatile("break");
    }
}

int main(void)
{
    console_on();
    stop_here();
    finish();
}
