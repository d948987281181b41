/* SPDX-License-Identifier: MIT */
#include "negative.h"

static void NOINLINE set_charger(void)
{
    DDRB |= _BV(PB5);
    if (!WRONG) {
        PORTB |= _BV(PB5); /* a short pulse of 0 is allowed */
    }
    for (uint32_t i = 0; i < 40000; i++) { /* more than 10 ms */
        __asm__ volatile("");
    }
}

int main(void)
{
    console_on();
    set_charger();
    finish();
}
