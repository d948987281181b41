/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* A second character right behind the first: the empty shift register takes the first one up to a bit later. */
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
