/* SPDX-License-Identifier: MIT */
#include "negative.h"

#ifndef START
#define START boot_page_erase(PAGE)
#endif

/* SPM while the EEPROM is being written: the chip blocks it. */
static void NOINLINE start_while_eeprom_writes(void)
{
    eeprom_write_byte((uint8_t *)0x123, 0x45);
    if (!WRONG) {
        eeprom_busy_wait();
    }
    START;
    boot_spm_busy_wait();
}

int main(void)
{
    console_on();
    start_while_eeprom_writes();
    finish();
}
