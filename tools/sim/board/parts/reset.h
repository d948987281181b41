/* SPDX-License-Identifier: MIT
 * reset.h - reset causes, the watchdog, IVSEL; also how simavr's core asks about SPM and WDR. */
#ifndef SIM_PARTS_RESET_H
#define SIM_PARTS_RESET_H

#include "board.h"

typedef struct {
    uint8_t mcucsr, wdtcr;
    uint64_t watchdog_open, ivsel_open; /* ends of the timed sequences */
    uint32_t count;
    reset_cause_t cause;
    bool held, pending;
    reset_cause_t pending_cause;
} reset_t;

void reset_init(board_t *board);

/* All registers to their reset values; SRAM, flash, EEPROM and the CPU's 32 registers are not touched. */
void reset_now(board_t *board, reset_cause_t cause);
void reset_event(board_t *board, uint64_t now); /* the watchdog's time is over */
bool reset_watchdog_runs(const board_t *board);

#endif
