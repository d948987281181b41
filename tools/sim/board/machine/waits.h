/* SPDX-License-Identifier: MIT
 * waits.h - counts the rounds of a loop that only waits, instead of executing them. waits.c says how. */
#ifndef SIM_WAITS_H
#define SIM_WAITS_H

#include "machine.h"

#define WAITS_STATE_BYTES 46 /* pc, r0..r31, SREG, SP */

typedef struct {
    machine_t *machine;
    bool on;
    bool touched;                           /* since the last jump back: something other than registers and stack */
    bool knows_ram;                         /* `ram` holds the SRAM of the last jump back */
    uint64_t at;                            /* cycle of the last jump back */
    uint8_t state[WAITS_STATE_BYTES];       /* state of the chip after it */
    uint8_t ram[M128_RAM_END - M128_RAM_START];
} waits_t;

void waits_skip(waits_t *waits, bool on);         /* board_skip_waits() */
void waits_passed(waits_t *waits, uint32_t pc); /* the instruction at pc was executed */
void waits_disturbed(waits_t *waits);           /* something else happened: an event, an interrupt, an outside call */

#endif
