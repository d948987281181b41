/* SPDX-License-Identifier: MIT */
#include "board_memory.h"

#include <string.h>

#include "board_struct.h"

static size_t clip(uint32_t address, size_t count, size_t size)
{
    return address >= size ? 0 : count < size - address ? count : size - address;
}

size_t board_flash_read(const board_t *board, uint32_t address, uint8_t *to, size_t count)
{
    count = clip(address, count, M128_FLASH_BYTES);
    memcpy(to, board->cpu.machine.avr->flash + address, count);
    return count;
}

size_t board_flash_write(board_t *board, uint32_t address, const uint8_t *from, size_t count)
{
    count = clip(address, count, M128_FLASH_BYTES);
    memcpy(board->cpu.machine.avr->flash + address, from, count);
    if (count) {
        machine_code_changed(&board->cpu.machine, address, (uint32_t)count);
    }
    return count;
}

size_t board_eeprom_read(const board_t *board, uint32_t address, uint8_t *to, size_t count)
{
    count = clip(address, count, M128_EEPROM_BYTES);
    memcpy(to, board->eeprom.bytes + address, count);
    return count;
}

size_t board_eeprom_write(board_t *board, uint32_t address, const uint8_t *from, size_t count)
{
    count = clip(address, count, M128_EEPROM_BYTES);
    memcpy(board->eeprom.bytes + address, from, count);
    return count;
}

size_t board_ram_read(const board_t *board, uint32_t address, uint8_t *to, size_t count)
{
    count = clip(address, count, M128_RAM_END);
    memcpy(to, board->cpu.machine.avr->data + address, count);
    return count;
}

size_t board_ram_write(board_t *board, uint32_t address, const uint8_t *from, size_t count)
{
    count = address < M128_RAM_START ? 0 : clip(address, count, M128_RAM_END);
    memcpy(board->cpu.machine.avr->data + address, from, count);
    return count;
}

void board_set_lock(board_t *board, uint8_t lock) { board->flash.lock = lock | 0xC0; }

void board_set_fuses(board_t *board, uint8_t low, uint8_t high, uint8_t extended)
{
    board->flash.fuses[0] = low;
    board->flash.fuses[1] = high;
    board->flash.fuses[2] = extended;
}

uint32_t board_flash_wear(const board_t *board, uint32_t page)
{
    return page < M128_PAGES ? board->flash.wear[page] : 0;
}

uint32_t board_eeprom_wear(const board_t *board, uint32_t address)
{
    return address < M128_EEPROM_BYTES ? board->eeprom.wear[address] : 0;
}

void board_age_flash(board_t *board, uint32_t page, uint32_t erases)
{
    if (page < M128_PAGES) {
        board->flash.wear[page] = erases;
    }
}

void board_age_eeprom(board_t *board, uint32_t address, uint32_t writes)
{
    if (address < M128_EEPROM_BYTES) {
        board->eeprom.wear[address] = writes;
    }
}

uint64_t board_operations(const board_t *board) { return board->operations.count; }

bool board_operation(const board_t *board, uint64_t n, operation_kind_t *kind, uint32_t *address)
{
    return operation_find(&board->operations, n, kind, address);
}

void board_on_operation(board_t *board, board_operation_fn done, void *context)
{
    board->operations.done = done;
    board->operations.done_context = context;
}
