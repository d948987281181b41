/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Two stop bits, which the far end does not use. */
static void NOINLINE set_format(void)
{
    UCSR1C = WRONG ? _BV(USBS1) | _BV(UCSZ11) | _BV(UCSZ10) : _BV(UCSZ11) | _BV(UCSZ10);
}

int main(void)
{
    console_on();
    set_format();
    finish();
}
