/* SPDX-License-Identifier: MIT
 * asleep.c - a robot that sleeps and wakes for a tick 128 times a second, like the idle firmware. */
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

EMPTY_INTERRUPT(TIMER1_COMPA_vect)

int main(void)
{
    PORTB |= 1 << PB5; /* charger off */
    DDRB |= 1 << PB5;
    OCR1A = 125000 / 8 - 1; /* 128 Hz at clk/8 */
    TCCR1B = 1 << WGM12 | 1 << CS11;
    TIMSK = 1 << OCIE1A;
    sei();
    for (;;) {
        sleep_mode();
    }
}
