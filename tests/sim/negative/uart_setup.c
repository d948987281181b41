/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Changes the rate before the last character has left. */
static void NOINLINE change_rate(void)
{
    put('.');
    while (!WRONG && !(UCSR1A & _BV(TXC1))) {
    }
    UBRR1L = 34;
}

int main(void)
{
    console_on();
    change_rate();
    finish();
}
