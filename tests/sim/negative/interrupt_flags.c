/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* An interrupt routine without prologue that changes two flags and does not restore them. */
ISR(TIMER0_OVF_vect, ISR_NAKED)
{
#if WRONG
    __asm__ volatile("sec \n\t"
                     "seh \n\t"
                     "reti");
#else
    __asm__ volatile("push r24 \n\t"
                     "in r24, __SREG__ \n\t"
                     "sec \n\t"
                     "seh \n\t"
                     "out __SREG__, r24 \n\t"
                     "pop r24 \n\t"
                     "reti");
#endif
}

static void NOINLINE work(void)
{
    TCCR0 = _BV(CS00);
    TIMSK = _BV(TOIE0);
    sei();
    for (volatile uint16_t i = 0; i < 500; i++) {
    }
    cli();
}

int main(void)
{
    console_on();
    work();
    finish();
}
