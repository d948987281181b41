/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Another rate before the last character has left at the old one. */
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
