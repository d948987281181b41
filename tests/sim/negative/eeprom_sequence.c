/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* EEWE must follow EEMWE within four cycles. */
static void NOINLINE write_late(void)
{
    EEAR = 0x123;
    EEDR = 0x45;
    EECR |= _BV(EEMWE);
    if (WRONG) {
        __asm__ volatile("nop\n\t nop\n\t nop\n\t nop\n\t nop\n\t");
    }
    EECR |= _BV(EEWE);
}

int main(void)
{
    console_on();
    write_late();
    finish();
}
