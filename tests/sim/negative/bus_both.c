/* SPDX-License-Identifier: MIT */
#include "negative.h"

static void NOINLINE turn_round(void)
{
    PORTE |= _BV(PE2);
    if (!WRONG) {
        PORTE &= (uint8_t)~_BV(PE2);
    }
    PORTE |= _BV(PE3);
}

int main(void)
{
    console_on();
    bus_on();
    turn_round();
    finish();
}
