/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* SPM while the EEPROM is being written: the chip blocks it. */
static void NOINLINE erase_while_eeprom_writes(void)
{
    eeprom_write_byte((uint8_t *)0x123, 0x45);
    if (!WRONG) {
        eeprom_busy_wait();
    }
    boot_page_erase(PAGE);
    boot_spm_busy_wait();
}

int main(void)
{
    console_on();
    erase_while_eeprom_writes();
    finish();
}
