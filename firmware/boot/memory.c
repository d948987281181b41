/* SPDX-License-Identifier: MIT */
#include "memory.h"

#include "app_record.h"
#include "crc16.h"
#include "journal.h"
#include "service.h"
#include "uart.h"

#include <avr/eeprom.h>
#include <avr/io.h>
#include <avr/pgmspace.h>
#include <avr/wdt.h>
#include <string.h>

uint8_t memory_work[MEMORY_WORK_BYTES];
memory_cursor_t memory_cursor;
uint16_t memory_rewrites;
memory_scan_t memory_sums;
bool memory_app_came;

NOINLINE uint32_t flash_addr(uint16_t page)
{
    return (uint32_t)page * FLASH_PAGE_BYTES;
}

void flash_read(uint32_t addr, void *to, uint16_t bytes)
{
    uint8_t *p = to;
    while (bytes--) {
        *p++ = pgm_read_byte_far(addr++);
    }
}

bool flash_equals(uint32_t addr, const void *data, uint16_t bytes)
{
    const uint8_t *p = data;
    while (bytes--) {
        if (pgm_read_byte_far(addr++) != *p++) {
            return false;
        }
    }
    return true;
}

/* BOOT_OK, BOOT_ERR_RANGE and BOOT_ERR_VERIFY equal FLASH_OK, FLASH_ERR_RANGE and FLASH_ERR_VERIFY. */
static flash_status_t write_page(uint16_t page, const uint8_t *data, uint16_t bytes, uint8_t mode)
{
    uint16_t result = boot_write_page(flash_addr(page), data, bytes, mode, &uart_rx);
    memory_rewrites += result >> 8;
    return (flash_status_t)(uint8_t)result;
}

flash_status_t flash_write(uint16_t page, const uint8_t *data, uint16_t bytes)
{
    return write_page(page, data, bytes, BOOT_MODE_WRITE);
}

flash_status_t flash_program(uint16_t page, const uint8_t *data, uint16_t bytes)
{
    return write_page(page, data, bytes, BOOT_MODE_PROGRAM);
}

NOINLINE void memory_seek(uint32_t addr)
{
    memory_cursor.addr = addr;
}

uint8_t memory_next(void)
{
    memory_cursor_t at = memory_cursor;
    memory_cursor.addr++;
    if (at.byte[2] == MEMORY_EEPROM >> 16) {
        return memory_ee(at.low);
    }
    if (at.byte[2] == MEMORY_RAM >> 16) {
        return *(const volatile uint8_t *)at.low;
    }
    at.byte[2] &= (MEM_BOOT_END - 1) >> 16; /* wraps at the end of flash, as the chip does */
    return pgm_read_byte_far(at.addr);
}

void memory_read_page(uint16_t page, uint8_t *to)
{
    flash_read(flash_addr(page % FLASH_PAGES), to, FLASH_PAGE_BYTES);
}

void memory_fetch(void *to, uint16_t count)
{
    uint8_t *byte = to;
    while (count--) {
        *byte++ = memory_next();
    }
}

memory_result_t memory_commit(uint16_t page, const uint8_t *data)
{
    if (page >= MEM_BOOT_START / 256) {
        return MEMORY_REFUSED;
    }
    if (flash_equals(flash_addr(page), data, FLASH_PAGE_BYTES)) {
        return MEMORY_EQUAL;
    }
    if (page >= MEM_MOTION_START / 256 && journal_void() != FLASH_OK) {
        return MEMORY_BROKEN;
    }
    return flash_write(page, data, FLASH_PAGE_BYTES) == FLASH_OK ? MEMORY_WRITTEN : MEMORY_BROKEN;
}

bool memory_write_work(uint16_t page)
{
    if (page == 0) {
        memory_app_came = true;
        memory_ee_set(MEM_EE_APP_MARK, MARK_INCOMPLETE);
    }
    if (memory_commit(page, memory_work) <= MEMORY_EQUAL) {
        return true;
    }
    memory_app_came = false;   /* avrdude ends its session as usual after an error, even with a good exit code */
    return false;
}

void memory_download_good(void)
{
    if (memory_app_came) {
        memory_ee_set(MEM_EE_APP_MARK, MARK_NONE);
    }
}

uint8_t memory_ee(uint16_t addr)
{
    return eeprom_read_byte((const uint8_t *)(addr & (MEM_EEPROM_BYTES - 1)));
}

void memory_ee_set(uint16_t addr, uint8_t value)
{
    wdt_reset();
    eeprom_update_byte((uint8_t *)addr, value);
    eeprom_busy_wait();
}

bool memory_ee_write(uint16_t addr, const void *from, uint16_t count)
{
    const uint8_t *byte = from;
    if (addr > MEM_EEPROM_BYTES - count) {
        return false;
    }
    for (uint16_t i = 0; i < count; i++) {
        memory_ee_set(addr + i, byte[i]);
    }
    return true;
}

void memory_scan_start(void)
{
    memory_sums.sum = 0;
    memory_sums.all = 0xFF;
}

void memory_scan(uint16_t page)
{
    memory_scan_t sums = memory_sums;
    uint8_t at = 0;
    memory_read_page(page, memory_scratch);
    do {
        uint8_t byte = memory_scratch[at];
        sums.crc = crc16_byte(sums.crc, byte);
        sums.sum += byte;
        sums.all &= byte;
    } while (++at != 0);
    memory_sums = sums;
}

#define MAGIC_LE 0x3231354Dul /* APP_RECORD_MAGIC read as a number */
#define LENGTH_AT (MEM_APP_RECORD + APP_RECORD_AT_LENGTH)
#define CRC_AT (MEM_APP_RECORD + APP_RECORD_AT_CRC)

/* A magic with extra bits set was half erased or half written when the power failed: the image is ours and damaged. The
 * CRC treats its own two bytes as 0xFF (app_record.h). The application is below 64 KiB, so near reads suffice: 46 cycles
 * per byte, 60 ms for 20 KiB. The low half of the length is enough, because the CRC covers the high one. */
memory_app_t memory_app(void)
{
    uint16_t length = pgm_read_word(LENGTH_AT);
    uint16_t crc = CRC16_START;
    if (pgm_read_word(MEM_APP_START) == 0xFFFF) {
        return MEMORY_APP_NONE;
    }
    if ((pgm_read_dword(MEM_APP_RECORD) & MAGIC_LE) != MAGIC_LE) {
        return memory_ee(MEM_EE_APP_MARK) == MARK_INCOMPLETE ? MEMORY_APP_BAD : MEMORY_APP_PLAIN;
    }
    for (uint16_t at = 0; at != length; at++) {
        crc = crc16_byte(crc, (at & ~1u) == CRC_AT ? 0xFF : pgm_read_byte(at));
    }
    return crc == pgm_read_word(CRC_AT) && length <= MEM_APP_END ? MEMORY_APP_GOOD : MEMORY_APP_BAD;
}

bool memory_is_startable(void)
{
    uint8_t app = (uint8_t)memory_app();
    return app == MEMORY_APP_PLAIN || app == MEMORY_APP_GOOD;
}
