/* SPDX-License-Identifier: MIT
 * waits.h - rounds of a loop that only waits are counted instead of executed: waits.c. */
#ifndef SIM_PARTS_WAITS_H
#define SIM_PARTS_WAITS_H

#include "board_debug.h"
#include "m128.h"

#define WAITS_STATE_BYTES 46 /* pc, r0..r31, SREG, SP */

typedef struct {
    bool on;
    bool touched;                           /* since the last jump back: something beside registers and stack */
    bool knows_ram;                         /* `ram` is as it was at the last jump back */
    uint64_t at;                            /* the last jump back, */
    uint8_t state[WAITS_STATE_BYTES];       /* and the chip behind it */
    uint8_t ram[M128_RAM_END - M128_RAM_START];
    uint8_t kind[M128_FLASH_BYTES / 2];     /* of each instruction, while `on` */
} waits_t;

void waits_passed(board_t *board, uint32_t pc); /* the instruction at pc was executed */
void waits_disturbed(board_t *board);           /* something else happened: an event, an interrupt, a call from outside */
void waits_flash_changed(board_t *board, uint32_t address, uint32_t count);

#endif
