/* SPDX-License-Identifier: MIT */
#include "fake_eeprom.h"
#include "eeprom.h"
#include "trap.h"

#include <string.h>

static uint8_t bytes[EEPROM_BYTES];
static uint32_t wear[EEPROM_BYTES];
static bool is_worn_out[EEPROM_BYTES];
static uint32_t writes, cut_at;
static uint8_t busy_calls, busy_left;
static int torn;
static jmp_buf *cut_to;

void fake_eeprom_reset(void)
{
    memset(bytes, 0xFF, sizeof bytes);
    memset(wear, 0, sizeof wear);
    memset(is_worn_out, 0, sizeof is_worn_out);
    writes = 0;
    cut_at = 0;
    busy_calls = 2;
    busy_left = 0;
}

uint8_t *fake_eeprom_bytes(void)
{
    return bytes;
}

void fake_eeprom_wear_out(uint16_t address)
{
    ASSERT(address < EEPROM_BYTES);
    is_worn_out[address] = true;
}

void fake_eeprom_set_busy_calls(uint8_t calls)
{
    busy_calls = calls;
}

uint32_t fake_eeprom_wear(uint16_t address)
{
    ASSERT(address < EEPROM_BYTES);
    return wear[address];
}

uint32_t fake_eeprom_writes(void)
{
    return writes;
}

void fake_eeprom_cut(uint32_t operation, int torn_value, jmp_buf *where)
{
    cut_at = operation == 0 ? 0 : writes + operation;
    torn = torn_value;
    cut_to = where;
    busy_left = 0;
}

/* Changes the cell at once and leaves the device busy: nobody can read the cell before the write is done. */
static void write_cell(uint16_t address, uint8_t byte)
{
    writes++;
    wear[address]++;
    if (writes == cut_at) {
        cut_at = 0;
        if (torn >= 0) {
            bytes[address] = torn > 255 ? byte : (uint8_t)torn;
        }
        longjmp(*cut_to, 1);
    }
    bytes[address] = is_worn_out[address] ? bytes[address] : byte;
    busy_left = busy_calls;
}

bool eeprom_is_busy(void)
{
    if (busy_left == 0) {
        return false;
    }
    busy_left--;
    return true;
}

void eeprom_wait(void)
{
    busy_left = 0;
}

void eeprom_read(uint16_t address, void *to, uint16_t count)
{
    ASSERT((uint32_t)address + count <= EEPROM_BYTES);
    eeprom_wait();
    memcpy(to, bytes + address, count);
}

uint8_t eeprom_byte(uint16_t address)
{
    uint8_t byte;
    eeprom_read(address, &byte, 1);
    return byte;
}

bool eeprom_start(uint16_t address, uint8_t byte)
{
    ASSERT(address < EEPROM_BYTES);
    if (eeprom_is_busy()) {
        return false;
    }
    if (bytes[address] != byte) {
        write_cell(address, byte);
    }
    return true;
}

void eeprom_update(uint16_t address, const void *from, uint16_t count)
{
    const uint8_t *byte = from;
    ASSERT((uint32_t)address + count <= EEPROM_BYTES);
    for (; count > 0; count--) {
        eeprom_wait();
        (void)eeprom_start(address++, *byte++);
    }
    eeprom_wait();
}
