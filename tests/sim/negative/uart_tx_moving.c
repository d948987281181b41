/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Writes a second character right after the first, which reaches the empty shift register only up to a bit later. */
static void NOINLINE send_two(void)
{
    UDR1 = '.';
    while (!WRONG && !(UCSR1A & _BV(UDRE1))) {
    }
    UDR1 = '.';
}

int main(void)
{
    console_on();
    send_two();
    finish();
}
