/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Changes U2X before the last character has left. */
static void NOINLINE change_speed(void)
{
    put('.');
    while (!WRONG && !(UCSR1A & _BV(TXC1))) {
    }
    UCSR1A = 0;
    UCSR1A = _BV(U2X1);
}

int main(void)
{
    console_on();
    change_speed();
    finish();
}
