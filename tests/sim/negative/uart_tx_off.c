/* SPDX-License-Identifier: MIT */
#include "negative.h"

static void NOINLINE send_one(void)
{
    UCSR1B = WRONG ? _BV(RXEN1) : _BV(RXEN1) | _BV(TXEN1);
    UDR1 = '.';
}

int main(void)
{
    console_on();
    send_one();
    finish();
}
