/* SPDX-License-Identifier: MIT
 * flash.h - self-programming: SPM, SPMCSR, page buffer, RWW busy, lock bits, torn pages. */
#ifndef SIM_PARTS_FLASH_H
#define SIM_PARTS_FLASH_H

#include "board_memory.h"
#include "m128.h"

typedef struct {
    uint16_t page[M128_PAGE_BYTES / 2];
    bool filled[M128_PAGE_BYTES / 2];
    uint8_t control;       /* SPMCSR as written */
    uint64_t armed_until;
    bool busy, rww_locked;
    operation_kind_t operation;
    uint32_t address;
    uint8_t lock, lock_new, fuses[3];
    bool locking;
    uint32_t wear[M128_PAGES];
} flash_t;

void flash_init(board_t *board);
void flash_reset(board_t *board);
void flash_spm(board_t *board); /* an SPM instruction is being executed */

/* Before an LPM, ELPM or SPM. true: it was done here, or must not be executed. */
bool flash_before_lpm(board_t *board, uint32_t pc, uint16_t opcode);

void flash_event(board_t *board, uint64_t now);

/* Ends an operation in progress in its middle; tear picks how. */
void flash_tear(board_t *board, uint32_t tear);

#endif
