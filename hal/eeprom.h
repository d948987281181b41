/* SPDX-License-Identifier: MIT
 * eeprom.h - the 4 KiB of EEPROM, byte by byte. A byte that changes takes 8.5 ms and wears its cell (100,000 times).
 * Main loop only. No RAM. After a power cut the byte being written may hold anything: check what you load. */
#ifndef EEPROM_H
#define EEPROM_H

#include <stdbool.h>
#include <stdint.h>

#define EEPROM_BYTES 4096u

/* Waits for a write in progress (at most 8.5 ms), then reads. address + count <= EEPROM_BYTES. */
void eeprom_read(uint16_t address, void *to, uint16_t count);
uint8_t eeprom_byte(uint16_t address);

/* Whether a write is in progress. */
bool eeprom_is_busy(void);

/* Begins to write one byte unless the cell already holds it. Returns at once. true: the byte is there or is being written.
 * false: another write is in progress; nothing was done. For work in small steps while a motion runs. */
bool eeprom_start(uint16_t address, uint8_t byte);

/* Blocks until no write is in progress. */
void eeprom_wait(void);

/* Writes the bytes that differ and waits until the last one is written: 8.5 ms each. Kicks the watchdog. Nothing may be
 * moving. */
void eeprom_update(uint16_t address, const void *from, uint16_t count);

#endif
