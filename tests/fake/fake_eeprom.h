/* SPDX-License-Identifier: MIT
 * fake_eeprom.h - 4 KiB of EEPROM in host memory, behind eeprom.h. Starts erased (0xFF). A write stays "busy" for a number
 * of eeprom_is_busy/eeprom_start calls; wear is counted; power can be cut at the n-th byte write. Ranges abort. */
#ifndef FAKE_EEPROM_H
#define FAKE_EEPROM_H

#include <setjmp.h>
#include <stdint.h>

void fake_eeprom_reset(void);
uint8_t *fake_eeprom_bytes(void);                 /* to set up and to compare */
void fake_eeprom_set_busy_calls(uint8_t calls);   /* how long a write takes, in calls; default 2 */
uint32_t fake_eeprom_wear(uint16_t address);      /* writes of this byte */
uint32_t fake_eeprom_writes(void);                /* all of them since reset */

/* At byte write `operation` (1 = the next one; 0 = never) the byte becomes `torn_value` (-1: it keeps its old value,
 * 256: the write completes first), then longjmp to `where`. */
void fake_eeprom_cut(uint32_t operation, int torn_value, jmp_buf *where);

#endif
