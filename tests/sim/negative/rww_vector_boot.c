/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Interrupts are on during an erase, with the vectors in the busy half, where they are after reset. Right: IVSEL moves
 * them into the boot section first. */
static volatile uint8_t ticks;

ISR(TIMER0_OVF_vect)
{
    ticks++;
}

static void NOINLINE erase_with_interrupts_on(void)
{
    TCCR0 = _BV(CS00);
    TIMSK = _BV(TOIE0);
    if (!WRONG) {
        MCUCR = _BV(IVCE);
        MCUCR = _BV(IVSEL);
    }
    sei();
    boot_page_erase(PAGE);
    boot_spm_busy_wait();
    cli();
    boot_rww_enable();
}

int main(void)
{
    console_on();
    erase_with_interrupts_on();
    finish();
}
