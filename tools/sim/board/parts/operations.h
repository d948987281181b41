/* SPDX-License-Identifier: MIT
 * operations.h - the count and log of flash and EEPROM operations, which of the two memories is busy, and the power cut
 * planned at one of them. */
#ifndef SIM_OPERATIONS_H
#define SIM_OPERATIONS_H

#include "board_memory.h"
#include "machine.h"

#define OPERATION_LOG 65536u
typedef struct {
    machine_t *machine;
    bool flash_busy, eeprom_busy; /* the chip allows only one at a time */
    uint64_t count;
    struct { uint8_t kind; uint32_t address; } log[OPERATION_LOG]; /* a ring */
    uint64_t cut_operation;
    cut_phase_t cut_phase;
    uint32_t cut_tear;
    board_operation_fn done;
    void *done_context;
} operations_t;

/* Every flash or EEPROM operation reports its start and its end. */
void operation_begins(operations_t *operations, operation_kind_t kind, uint32_t address);
void operation_is_done(operations_t *operations, operation_kind_t kind, uint32_t address);

/* For board_operation(). */
bool operation_find(const operations_t *operations, uint64_t n, operation_kind_t *kind, uint32_t *address);

#endif
