/* SPDX-License-Identifier: MIT
 * power.h - the supply, the count of flash and EEPROM operations, and cuts. */
#ifndef SIM_PARTS_POWER_H
#define SIM_PARTS_POWER_H

#include "board_memory.h"

#define OPERATION_LOG 65536u
typedef struct {
    bool on;
    uint64_t count;
    struct { uint8_t kind; uint32_t address; } *log; /* ring of OPERATION_LOG */
    uint64_t cut_operation;
    cut_phase_t cut_phase;
    uint32_t cut_tear;
    board_operation_fn done;
    void *done_context;
} power_t;

/* Every operation on flash or EEPROM says when it begins and when it has ended. */
void power_begin(board_t *board, operation_kind_t kind, uint32_t address);
void power_done(board_t *board, operation_kind_t kind, uint32_t address);
void power_event(board_t *board, uint64_t now);

#endif
