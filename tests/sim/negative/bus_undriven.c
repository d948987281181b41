/* SPDX-License-Identifier: MIT */
#include "negative.h"

static void NOINLINE send(void)
{
    if (!WRONG) {
        PORTE |= _BV(PE2);
    }
    bus_put(0xFF);
    bus_drained();
}

int main(void)
{
    console_on();
    bus_on();
    send();
    finish();
}
