/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* A status packet of six characters arrives at 1 Mbit/s and is not read in time. The test forbids this violation. */
static void NOINLINE ping(void)
{
    static const uint8_t packet[] = { 0xFF, 0xFF, 1, 2, 1, 0xFB };
    PORTE |= _BV(PE2);
    for (uint8_t i = 0; i < sizeof packet; i++) {
        bus_put(packet[i]);
    }
    bus_drained();
    PORTE = _BV(PE3);
    if (WRONG) {
        for (uint16_t i = 0; i < 4000; i++) {
            __asm__ volatile("");
        }
    }
    for (uint8_t i = 0; i < 6; i++) {
        while (!(UCSR0A & _BV(RXC0))) {
        }
        (void)UDR0;
    }
}

int main(void)
{
    console_on();
    bus_on();
    ping();
    finish();
}
