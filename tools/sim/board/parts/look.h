/* SPDX-License-Identifier: MIT
 * look.h - what only looks on: probes (probe.c), packets (trace.c), pins (vcd.c). */
#ifndef SIM_PARTS_LOOK_H
#define SIM_PARTS_LOOK_H

#include "board_debug.h"

struct probes;
struct trace;
struct vcd;

void probe_free(board_t *board);
void probe_reset(board_t *board);
void probe_enter(board_t *board, uint32_t pc);
void probe_leave(board_t *board, uint32_t pc);
void probe_mark(board_t *board); /* sets the notes again after the flash changed */
void trace_free(board_t *board);
void vcd_free(board_t *board);
void vcd_pins(board_t *board);
void vcd_byte(board_t *board, int uart, bool sent, int byte); /* -1: line idle */

#endif
