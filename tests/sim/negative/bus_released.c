/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Releases the line at "data register empty", with the last two characters still in the transmitter. */
static void NOINLINE send_packet(void)
{
    PORTE |= _BV(PE2);
    for (uint8_t i = 0; i < 6; i++) {
        bus_put(0xFF);
    }
    if (WRONG) {
        while (!(UCSR0A & _BV(UDRE0))) {
        }
    } else {
        bus_drained();
    }
    PORTE &= (uint8_t)~_BV(PE2);
}

int main(void)
{
    console_on();
    bus_on();
    send_packet();
    finish();
}
