/* SPDX-License-Identifier: MIT */
#include "negative.h"

ISR(TIMER0_OVF_vect)
{
}

static void NOINLINE doze(void)
{
    TCCR0 = _BV(CS00);
    TIMSK = _BV(TOIE0);
    if (!WRONG) {
        sei();
    }
    sleep_enable();
    sleep_cpu();
}

int main(void)
{
    console_on();
    doze();
    finish();
}
