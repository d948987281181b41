/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* The test first sets the wear of byte 0x123 to the limit. */
static void NOINLINE write_once_more(void)
{
    eeprom_write_byte((uint8_t *)(WRONG ? 0x123 : 0x124), 0x45);
    eeprom_busy_wait();
}

int main(void)
{
    console_on();
    write_once_more();
    finish();
}
