/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Writes a third character while one is shifted out and one waits. */
static void NOINLINE send_three(void)
{
    for (uint8_t i = 0; i < 3; i++) {
        while (!WRONG && !(UCSR1A & _BV(UDRE1))) {
        }
        UDR1 = '.';
    }
}

int main(void)
{
    console_on();
    send_three();
    finish();
}
