/* SPDX-License-Identifier: MIT
 * memory.h - the loader's memory access: one cursor over flash, EEPROM and RAM, flash pages with read-back, the
 * application's record. Implements flash.h for the loader. */
#ifndef MEMORY_H
#define MEMORY_H

#include "flash.h"
#include "memory_map.h"

#include <stdbool.h>
#include <stdint.h>

/* The only large buffer; one user at a time. memory_scan uses its second half. */
#define MEMORY_WORK_BYTES 2048u
extern uint8_t memory_work[MEMORY_WORK_BYTES];
#define memory_scratch (memory_work + 1024)

/* One address space for all readable memory: flash from 0, then RAM (including registers) and EEPROM. */
#define MEMORY_RAM 0x800000ul
#define MEMORY_EEPROM 0x810000ul

/* Where memory_next reads. May be set at any time, as a whole or by bytes (low first; the third one selects the memory). */
typedef union {
    uint32_t addr;
    uint8_t byte[4];
    uint16_t low;
} memory_cursor_t;
extern memory_cursor_t memory_cursor;

/* Moves the cursor. */
void memory_seek(uint32_t addr);

/* Returns the byte at the cursor and advances it. Flash and EEPROM wrap at their end. */
uint8_t memory_next(void);

/* Reads the next `count` bytes. */
void memory_fetch(void *to, uint16_t count);

/* Reads flash page `page` modulo FLASH_PAGES. */
void memory_read_page(uint16_t page, uint8_t *to);

/* Writes 256 bytes to flash page `page` unless it already holds them. Up to ten tries, like the original; memory_rewrites
 * counts the failed ones. Drops a pending journal record before the first change of the motion area. */
typedef enum { MEMORY_WRITTEN = 0, MEMORY_EQUAL = 1, MEMORY_REFUSED = 2, MEMORY_BROKEN = 3 } memory_result_t;
memory_result_t memory_commit(uint16_t page, const uint8_t *data);

/* The same with the first 256 bytes of memory_work. true: the page now holds them. Page 0 is the first one of an
 * application: from it on, until memory_download_good, EEPROM says that the application is incomplete. After a false it
 * says so until page 0 comes again. */
bool memory_write_work(uint16_t page);
extern uint16_t memory_rewrites;

/* A download has ended well: if page 0 came with it, the application is complete. */
void memory_download_good(void);
extern bool memory_app_came; /* memory_write_work had page 0 since the last prompt, and no page has failed since */

/* What EEPROM MEM_EE_APP_MARK says. Every other value counts as MARK_NONE: the byte may be another program's. */
#define MARK_INCOMPLETE 0x50u
#define MARK_NONE 0xFFu

/* EEPROM: reads are modulo its size. Only bytes that differ are written, 8.5 ms each. */
uint8_t memory_ee(uint16_t addr);
void memory_ee_set(uint16_t addr, uint8_t value);   /* addr < MEM_EEPROM_BYTES */

/* Writes at most MEM_EEPROM_BYTES. false: they would reach beyond the end; nothing was written. */
bool memory_ee_write(uint16_t addr, const void *from, uint16_t count);

/* CRC-16 over several pages, and sum and AND of one page. memory_scan first copies the page to memory_scratch. */
typedef struct {
    uint16_t crc; /* set to CRC16_START at the beginning of an area */
    uint16_t sum; /* set to 0 at the beginning of a page */
    uint8_t all;  /* AND; set to 0xFF likewise */
} memory_scan_t;
extern memory_scan_t memory_sums;
void memory_scan_start(void);
void memory_scan(uint16_t page);

/* The application: none; without a record (started unchecked); its record is correct; its record is wrong, or it has none
 * and its download has not ended well. */
typedef enum { MEMORY_APP_NONE = 0, MEMORY_APP_PLAIN = 1, MEMORY_APP_GOOD = 2, MEMORY_APP_BAD = 3 } memory_app_t;
memory_app_t memory_app(void);

/* Whether it may be started: present, and not known to be damaged. */
bool memory_is_startable(void);

#endif
