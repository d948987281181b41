/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Four characters arrive and none is read: the receiver holds three. The test sends the characters. */
static void NOINLINE wait_for(uint8_t characters)
{
    while (characters--) {
        __builtin_avr_delay_cycles(2800); /* a character at 57,143 */
    }
}

int main(void)
{
    console_on();
    say("send\n");
    wait_for(WRONG ? 8 : 2);
    for (uint8_t i = 0; i < 4; i++) {
        while (!(UCSR1A & _BV(RXC1))) {
        }
        put((char)UDR1);
    }
    finish();
}
