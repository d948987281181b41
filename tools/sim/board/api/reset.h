/* SPDX-License-Identifier: MIT
 * reset.h - resets and their causes, IVSEL; also how simavr's core asks about SPM and WDR. */
#ifndef SIM_RESET_H
#define SIM_RESET_H

#include "board.h"

void reset_init(board_t *board);

/* All registers to their reset values; SRAM, flash, EEPROM and the CPU's 32 registers are not touched. */
void reset_now(board_t *board, reset_cause_t cause);

#endif
