/* SPDX-License-Identifier: MIT
 * eeprom.h - the 4 KiB of EEPROM, byte by byte. A byte that changes takes 8.5 ms and wears its cell (100,000 times).
 * Main loop only. No RAM. After a power cut the byte under way may hold anything: check what you load. */
#ifndef EEPROM_H
#define EEPROM_H

#include <stdbool.h>
#include <stdint.h>

#define EEPROM_BYTES 4096u

/* Waits for a write under way (at most 8.5 ms), then reads. address + count <= EEPROM_BYTES. */
void eeprom_read(uint16_t address, void *to, uint16_t count);
uint8_t eeprom_byte(uint16_t address);

/* Whether a write is under way. */
bool eeprom_is_busy(void);

/* Begins to write one byte unless it is there already. Returns at once: false when a write is under way (nothing done),
 * true when the byte is equal or being written. For work in small steps beside a running motion. */
bool eeprom_start(uint16_t address, uint8_t byte);

/* Blocks until no write is under way. */
void eeprom_wait(void);

/* Writes what differs and waits for the end: 8.5 ms a changed byte, kicks the watchdog. Not while something moves. */
void eeprom_update(uint16_t address, const void *from, uint16_t count);

#endif
