/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Changes the address while a byte is being written. */
static void NOINLINE write_two(void)
{
    eeprom_write_byte((uint8_t *)0x123, 0x45);
    if (!WRONG) {
        eeprom_busy_wait();
    }
    EEAR = 0x124;
}

int main(void)
{
    console_on();
    write_two();
    finish();
}
