/* SPDX-License-Identifier: MIT
 * EEPROM of the ATmega128 for the loader built on a PC. Pointers carry EEPROM addresses; do not dereference them. */
#ifndef LOADER_EEPROM_H
#define LOADER_EEPROM_H

#include <stdint.h>

uint8_t eeprom_read_byte(const uint8_t *address);
void eeprom_update_byte(uint8_t *address, uint8_t value);
static inline void eeprom_busy_wait(void)
{
}

#endif
