/* SPDX-License-Identifier: MIT */
#include "negative.h"

ISR(TIMER0_OVF_vect)
{
}

/* Power-down stops the timers and UARTs that the program needs. */
static void NOINLINE doze(void)
{
    TCCR0 = _BV(CS00);
    TIMSK = _BV(TOIE0);
    set_sleep_mode(WRONG ? SLEEP_MODE_PWR_DOWN : SLEEP_MODE_IDLE);
    sleep_enable();
    sei();
    sleep_cpu();
}

int main(void)
{
    console_on();
    doze();
    finish();
}
