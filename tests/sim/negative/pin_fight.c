/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* A button pin as output is shorted when the button is pressed. */
static void NOINLINE set_pins(void)
{
    DDRE = WRONG ? 0x1C : 0x0C;
}

int main(void)
{
    console_on();
    set_pins();
    finish();
}
