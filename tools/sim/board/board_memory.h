/* SPDX-License-Identifier: MIT
 * board_memory.h - the board's flash, EEPROM and SRAM from outside, their wear, and power cuts in the middle of a
 * write. Part of board.h. */
#ifndef SIM_BOARD_MEMORY_H
#define SIM_BOARD_MEMORY_H

#include <stddef.h>

#include "board.h"

/* Direct access, as with a programmer: no wear, no time. Ranges are clipped to the memory; the number of bytes done
 * is returned. */
size_t board_flash_read(const board_t *board, uint32_t address, uint8_t *to, size_t count);
size_t board_flash_write(board_t *board, uint32_t address, const uint8_t *from, size_t count);
size_t board_eeprom_read(const board_t *board, uint32_t address, uint8_t *to, size_t count);
size_t board_eeprom_write(board_t *board, uint32_t address, const uint8_t *from, size_t count);
size_t board_ram_read(const board_t *board, uint32_t address, uint8_t *to, size_t count); /* data space, 0..0x10FF */
size_t board_ram_write(board_t *board, uint32_t address, const uint8_t *from, size_t count); /* SRAM part only */

/* Lock bits as the chip has them (0xFF: none programmed), and the fuses that LPM can read: low, high, extended. */
void board_set_lock(board_t *board, uint8_t lock);
uint8_t board_lock(const board_t *board);
void board_set_fuses(board_t *board, uint8_t low, uint8_t high, uint8_t extended);

/* Wear: erases of a flash page (0..511), writes of an EEPROM byte, by the firmware. */
uint32_t board_flash_wear(const board_t *board, uint32_t page);
uint32_t board_eeprom_wear(const board_t *board, uint32_t address);

/* Makes them old: sets what the two functions above tell. */
void board_age_flash(board_t *board, uint32_t page, uint32_t erases);
void board_age_eeprom(board_t *board, uint32_t address, uint32_t writes);

/* Operations so far: every page erase, page write and EEPROM byte write counts one, from 1 on. */
typedef enum { OPERATION_ERASE, OPERATION_WRITE, OPERATION_EEPROM } operation_kind_t;
uint64_t board_operations(const board_t *board);

/* What operation number n was (of the last 65,536), and where: a flash byte address or an EEPROM address. */
bool board_operation(const board_t *board, uint64_t n, operation_kind_t *kind, uint32_t *address);

/* Cuts the power at an operation counted from board_new(): as it begins, with nothing changed; in its middle, with
 * contents torn as tear (any number) picks; or when it has just ended. One cut at a time; operation 0: none. */
typedef enum { CUT_BEFORE, CUT_DURING, CUT_AFTER } cut_phase_t;
void board_cut_power(board_t *board, uint64_t operation, cut_phase_t phase, uint32_t tear);

/* Cuts the power at this cycle, whatever is going on. UINT64_MAX: none. A write in progress is torn. */
void board_cut_power_at(board_t *board, uint64_t cycle);

/* Called at the end of each operation that was not cut. */
typedef void (*board_operation_fn)(void *context, uint64_t now_cycles, operation_kind_t kind, uint32_t address);
void board_on_operation(board_t *board, board_operation_fn done, void *context);

#endif
