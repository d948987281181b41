/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Pushes before the start-up code has set the stack pointer. */
__attribute__((naked, used, section(".init0"))) void too_early(void);
void too_early(void)
{
    if (WRONG) {
        __asm__ volatile("push r0");
    }
}

int main(void)
{
    console_on();
    finish();
}
