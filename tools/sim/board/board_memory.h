/* SPDX-License-Identifier: MIT
 * board_memory.h - access to the board's flash, EEPROM and SRAM from outside, their wear, and power cuts in the middle
 * of a write. Part of board.h. */
#ifndef SIM_BOARD_MEMORY_H
#define SIM_BOARD_MEMORY_H

#include <stddef.h>

#include "board.h"

/* Direct access, as with a programmer: no wear, no time. Clips the range to the memory and returns the number of bytes
 * copied. */
size_t board_flash_read(const board_t *board, uint32_t address, uint8_t *to, size_t count);
size_t board_flash_write(board_t *board, uint32_t address, const uint8_t *from, size_t count);
size_t board_eeprom_read(const board_t *board, uint32_t address, uint8_t *to, size_t count);
size_t board_eeprom_write(board_t *board, uint32_t address, const uint8_t *from, size_t count);
size_t board_ram_read(const board_t *board, uint32_t address, uint8_t *to, size_t count); /* data space, 0..0x10FF */
size_t board_ram_write(board_t *board, uint32_t address, const uint8_t *from, size_t count); /* SRAM part only */

/* Lock bits (0xFF: none programmed), and the fuses that LPM can read: low, high, extended. */
void board_set_lock(board_t *board, uint8_t lock);
void board_set_fuses(board_t *board, uint8_t low, uint8_t high, uint8_t extended);

/* Wear by the firmware: erases of a flash page (0..511), writes of an EEPROM byte. */
uint32_t board_flash_wear(const board_t *board, uint32_t page);
uint32_t board_eeprom_wear(const board_t *board, uint32_t address);

/* Sets the wear counters above. */
void board_age_flash(board_t *board, uint32_t page, uint32_t erases);
void board_age_eeprom(board_t *board, uint32_t address, uint32_t writes);

/* Number of operations so far: page erases, page writes and EEPROM byte writes. The first one is number 1. */
typedef enum { OPERATION_ERASE, OPERATION_WRITE, OPERATION_EEPROM } operation_kind_t;
uint64_t board_operations(const board_t *board);

/* Kind and address (flash byte or EEPROM) of operation number n. Only the last 65,536 are known. */
bool board_operation(const board_t *board, uint64_t n, operation_kind_t *kind, uint32_t *address);

/* Cuts the power at an operation, counted since board_new(): before it (nothing changed), in its middle (contents torn
 * as `tear`, any number, picks) or right after it. Only one cut is armed at a time. operation 0: none. */
typedef enum { CUT_BEFORE, CUT_DURING, CUT_AFTER } cut_phase_t;
void board_cut_power(board_t *board, uint64_t operation, cut_phase_t phase, uint32_t tear);

/* Cuts the power at this cycle and tears a write in progress. UINT64_MAX: none. */
void board_cut_power_at(board_t *board, uint64_t cycle);

/* Called at the end of each operation that was not cut. */
typedef void (*board_operation_fn)(void *context, uint64_t now_cycles, operation_kind_t kind, uint32_t address);
void board_on_operation(board_t *board, board_operation_fn done, void *context);

#endif
