/* SPDX-License-Identifier: MIT
 * fake_eeprom.h - 4 KiB of EEPROM in host memory for eeprom.h. Starts erased (0xFF). A write stays busy for a number of
 * eeprom_is_busy/eeprom_start calls. Counts wear and can cut the power at the n-th byte write. Bad ranges abort. */
#ifndef FAKE_EEPROM_H
#define FAKE_EEPROM_H

#include <setjmp.h>
#include <stdint.h>

void fake_eeprom_reset(void);
uint8_t *fake_eeprom_bytes(void);                 /* to prepare and compare */
void fake_eeprom_set_busy_calls(uint8_t calls);   /* calls that a write takes; default 2 */
uint32_t fake_eeprom_wear(uint16_t address);      /* writes of this byte */
void fake_eeprom_wear_out(uint16_t address);      /* until the reset this byte keeps its value, whatever is written */
uint32_t fake_eeprom_writes(void);                /* writes of all bytes since reset */

/* Cuts the power at byte write `operation` (1 = the next one; 0 = never), then jumps to `where`. The byte becomes
 * `torn_value` (-1: it keeps its old value, 256: the write completes first). */
void fake_eeprom_cut(uint32_t operation, int torn_value, jmp_buf *where);

#endif
