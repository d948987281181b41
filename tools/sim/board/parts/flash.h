/* SPDX-License-Identifier: MIT
 * flash.h - self-programming: SPM, SPMCSR, page buffer, RWW busy, lock bits, torn pages. */
#ifndef SIM_FLASH_H
#define SIM_FLASH_H

#include "operations.h"

typedef struct {
    machine_t *machine;
    operations_t *operations;
    uint16_t page[M128_PAGE_BYTES / 2];
    bool filled[M128_PAGE_BYTES / 2];
    uint8_t control;       /* SPMCSR as written */
    uint64_t armed_until;
    bool rww_locked;
    operation_kind_t operation;
    uint32_t address;
    uint8_t lock, lock_new, fuses[3];
    bool locking;
    uint32_t wear[M128_PAGES];
} flash_t;

void flash_init(flash_t *flash, machine_t *machine, operations_t *operations);
void flash_reset(flash_t *flash);
void flash_spm(flash_t *flash); /* executes an SPM instruction */

/* Interrupts an operation in progress; tear selects the result. */
void flash_tear(flash_t *flash, uint32_t tear);

#endif
