/* SPDX-License-Identifier: MIT */
#include "negative.h"

static void NOINLINE do_it(void)
{
    __asm__ volatile(".word 0x9403 + %0" : : "i"(WRONG)); /* 0x9403 is INC r0, 0x9404 is undefined */
}

int main(void)
{
    console_on();
    do_it();
    finish();
}
