/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* The reverse of spm_eeprom: starts an EEPROM write while the flash is being erased. */
static void NOINLINE write_while_flash_erases(void)
{
    boot_page_erase(PAGE);
    if (!WRONG) {
        boot_spm_busy_wait();
    }
    eeprom_write_byte((uint8_t *)0x123, 0x45);
}

int main(void)
{
    console_on();
    write_while_flash_erases();
    finish();
}
