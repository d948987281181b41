/* SPDX-License-Identifier: MIT
 * memory.c - flash.h (reading), boot_call.h and eeprom.h: two arrays whose changes the machine keeps. To the firmware this
 * is a board with our loader, so the journal protects a page against a power cut here as well. */
#include "hal/boot_call.h"
#include "hal/eeprom.h"
#include "hal/flash.h"

#include <string.h>
#include "host.h"
#include "linker/memory_map.h"
#include "machine.h"
#include "target.h"
#include "trap.h"

#define JOURNAL_BYTES ((uint32_t)(MEM_JOURNAL_END - MEM_JOURNAL_START))
#define PAGES_BYTES ((uint32_t)(TARGET_FLASH_END - TARGET_MOTION_START))

static uint8_t flash[TARGET_FLASH_END];   /* the chip's flash, and the pages above it */
static uint8_t eeprom[EEPROM_BYTES];
static bool eeprom_is_unsettled;

void host_recall(const void *record, uint16_t bytes)
{
    static const boot_api_head_t loader = {.signature = BOOT_API_SIGNATURE, .version = BOOT_API_VERSION,
                                           .features = BOOT_HAS_WRITE | BOOT_HAS_PROGRAM | BOOT_HAS_JOURNAL};
    memset(flash, 0xFF, sizeof flash);
    memset(eeprom, 0xFF, sizeof eeprom);
    memcpy(flash + MEM_APP_RECORD, record, bytes);
    memcpy(flash + MEM_BOOT_API, &loader, sizeof loader);
    (void)machine_recall(MACHINE_PAGES, flash + TARGET_MOTION_START, PAGES_BYTES);
    (void)machine_recall(MACHINE_JOURNAL, flash + MEM_JOURNAL_START, JOURNAL_BYTES);
    (void)machine_recall(MACHINE_EEPROM, eeprom, sizeof eeprom);
}

void host_settle(void)
{
    if (eeprom_is_unsettled) {
        eeprom_is_unsettled = false;
        machine_settle(MACHINE_EEPROM);
    }
}

/* ---- flash ---- */

uint32_t flash_addr(uint16_t page)
{
    return (uint32_t)page * FLASH_PAGE_BYTES;
}

void flash_read(uint32_t addr, void *to, uint16_t bytes)
{
    ASSERT(addr + bytes <= sizeof flash);
    memcpy(to, flash + addr, bytes);
}

bool flash_equals(uint32_t addr, const void *data, uint16_t bytes)
{
    ASSERT(addr + bytes <= sizeof flash);
    return memcmp(flash + addr, data, bytes) == 0;
}

/* As on the chip: erasing sets all bits to 1, programming sets some of them to 0. */
uint8_t boot_call_write(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode, const boot_rx_t *rx)
{
    const bool is_page = addr >= TARGET_MOTION_START && addr < TARGET_FLASH_END;
    const bool is_journal = addr >= MEM_JOURNAL_START && addr < MEM_JOURNAL_END;
    uint8_t wanted[FLASH_PAGE_BYTES];
    (void)rx;
    if (!(is_page || is_journal) || addr % FLASH_PAGE_BYTES != 0 || bytes > FLASH_PAGE_BYTES) {
        return BOOT_ERR_RANGE;
    }
    memcpy(wanted, flash + addr, sizeof wanted);
    if (mode == BOOT_MODE_WRITE) {
        memset(wanted, 0xFF, sizeof wanted);
    }
    for (uint16_t i = 0; i < bytes; i++) {
        wanted[i] &= data[i];
    }
    const uint32_t at = addr - (is_page ? TARGET_MOTION_START : MEM_JOURNAL_START);
    if (!machine_keep(is_page ? MACHINE_PAGES : MACHINE_JOURNAL, at, wanted, sizeof wanted, true)) {
        return BOOT_ERR_VERIFY;
    }
    memcpy(flash + addr, wanted, sizeof wanted);
    return BOOT_OK;
}

uint8_t boot_call_factory(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode)
{
    (void)addr;
    (void)data;
    (void)bytes;
    (void)mode;
    return BOOT_ERR_RANGE;
}

/* ---- EEPROM ---- */

void eeprom_read(uint16_t address, void *to, uint16_t count)
{
    ASSERT((uint32_t)address + count <= sizeof eeprom);
    memcpy(to, eeprom + address, count);
}

uint8_t eeprom_byte(uint16_t address)
{
    ASSERT(address < sizeof eeprom);
    return eeprom[address];
}

bool eeprom_is_busy(void)
{
    return false;
}

void eeprom_wait(void)
{
}

/* Bytes that cannot be kept stay in force until the program ends; the machine reports the failure. */
void eeprom_update(uint16_t address, const void *from, uint16_t count)
{
    ASSERT((uint32_t)address + count <= sizeof eeprom);
    if (memcmp(eeprom + address, from, count) != 0) {
        memcpy(eeprom + address, from, count);
        (void)machine_keep(MACHINE_EEPROM, address, from, count, false);
        eeprom_is_unsettled = true;
    }
}

bool eeprom_start(uint16_t address, uint8_t byte)
{
    eeprom_update(address, &byte, 1);
    return true;
}
