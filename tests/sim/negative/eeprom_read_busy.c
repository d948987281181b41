/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* EERE while EEWE is still set. */
static uint8_t NOINLINE read_too_early(void)
{
    eeprom_write_byte((uint8_t *)0x123, 0x45);
    if (!WRONG) {
        eeprom_busy_wait();
    }
    EECR |= _BV(EERE);
    return EEDR;
}

int main(void)
{
    console_on();
    put((char)read_too_early());
    finish();
}
