/* SPDX-License-Identifier: MIT */
#include "fake_flash.h"

#include "memory_map.h"
#include "trap.h"

#include <string.h>

static struct {
    uint8_t bytes[MEM_BOOT_END];
    uint32_t wear[FLASH_PAGES];
    uint32_t ops;
    uint32_t cut_op;
    fake_flash_phase_t cut_phase;
    uint32_t random;
    jmp_buf *cut_where;
    uint16_t broken_page;
    uint8_t broken_tries;
    uint16_t dead_from, dead_end;
} flash;

void fake_flash_reset(void)
{
    memset(&flash, 0, sizeof flash);
    memset(flash.bytes, 0xFF, sizeof flash.bytes);
}

uint8_t *fake_flash_bytes(void)
{
    return flash.bytes;
}

void fake_flash_cut(uint32_t op, fake_flash_phase_t phase, uint32_t seed, jmp_buf *where)
{
    flash.ops = 0;
    flash.cut_op = op;
    flash.cut_phase = phase;
    flash.random = seed * 2654435761u + 1u;
    flash.cut_where = where;
}

uint32_t fake_flash_ops(void)
{
    return flash.ops;
}

uint32_t fake_flash_wear(uint16_t page)
{
    return flash.wear[page];
}

void fake_flash_break(uint16_t page, uint8_t tries)
{
    flash.broken_page = page;
    flash.broken_tries = tries;
}

void fake_flash_break_all(uint16_t from, uint16_t end)
{
    flash.dead_from = from;
    flash.dead_end = end;
}

static uint8_t random_byte(void)
{
    flash.random = flash.random * 1664525u + 1013904223u;
    return (uint8_t)(flash.random >> 24);
}

/* Changes one page to `wanted`, only partly if the power is cut. */
static void operate(uint16_t page, const uint8_t wanted[FLASH_PAGE_BYTES])
{
    uint8_t *cell = flash.bytes + (uint32_t)page * FLASH_PAGE_BYTES;
    bool cut = ++flash.ops == flash.cut_op;
    bool broken = page == flash.broken_page && flash.broken_tries > 0;
    if (broken) {
        flash.broken_tries--;
    }
    broken = broken || (page >= flash.dead_from && page < flash.dead_end);
    for (uint16_t i = 0; i < FLASH_PAGE_BYTES && !broken; i++) {
        uint8_t change = (uint8_t)(cell[i] ^ wanted[i]);
        if (cut && flash.cut_phase == FAKE_FLASH_BEFORE) {
            change = 0;
        } else if (cut && flash.cut_phase == FAKE_FLASH_TORN) {
            change = (uint8_t)(change & random_byte());
        }
        cell[i] ^= change;
    }
    if (cut) {
        flash.cut_op = 0;
        longjmp(*flash.cut_where, 1);
    }
}

static flash_status_t program(uint16_t page, const uint8_t *data, uint16_t bytes)
{
    const uint8_t *cell = flash.bytes + (uint32_t)page * FLASH_PAGE_BYTES;
    uint8_t wanted[FLASH_PAGE_BYTES];
    for (uint16_t i = 0; i < FLASH_PAGE_BYTES; i++) {
        wanted[i] = i < bytes ? (uint8_t)(cell[i] & data[i]) : cell[i];
    }
    operate(page, wanted);
    return memcmp(cell, data, bytes) == 0 ? FLASH_OK : FLASH_ERR_VERIFY;
}

static bool is_writable(uint16_t page, uint16_t bytes)
{
    return page < MEM_BOOT_START / FLASH_PAGE_BYTES && bytes >= 2 && bytes <= FLASH_PAGE_BYTES && bytes % 2 == 0;
}

uint32_t flash_addr(uint16_t page)
{
    return (uint32_t)page * FLASH_PAGE_BYTES;
}

void flash_read(uint32_t addr, void *to, uint16_t bytes)
{
    ASSERT(addr + bytes <= sizeof flash.bytes);
    memcpy(to, flash.bytes + addr, bytes);
}

bool flash_equals(uint32_t addr, const void *data, uint16_t bytes)
{
    ASSERT(addr + bytes <= sizeof flash.bytes);
    return memcmp(flash.bytes + addr, data, bytes) == 0;
}

flash_status_t flash_write(uint16_t page, const uint8_t *data, uint16_t bytes)
{
    uint8_t erased[FLASH_PAGE_BYTES];
    if (!is_writable(page, bytes)) {
        return FLASH_ERR_RANGE;
    }
    memset(erased, 0xFF, sizeof erased);
    flash.wear[page]++;
    operate(page, erased);
    return program(page, data, bytes);
}

flash_status_t flash_program(uint16_t page, const uint8_t *data, uint16_t bytes)
{
    return is_writable(page, bytes) ? program(page, data, bytes) : FLASH_ERR_RANGE;
}
