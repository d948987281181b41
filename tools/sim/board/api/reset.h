/* SPDX-License-Identifier: MIT
 * reset.h - resets and their causes, IVSEL, and the requests of simavr's core for SPM and WDR. */
#ifndef SIM_RESET_H
#define SIM_RESET_H

#include "board.h"

void reset_init(board_t *board);

/* Sets all registers to their reset values. Keeps SRAM, flash, EEPROM and the CPU's 32 registers. */
void reset_now(board_t *board, reset_cause_t cause);

#endif
