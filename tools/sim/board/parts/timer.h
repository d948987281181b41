/* SPDX-License-Identifier: MIT
 * timer.h - the 16-bit timers 1 and 3. */
#ifndef SIM_PARTS_TIMER_H
#define SIM_PARTS_TIMER_H

#include "board.h"

typedef struct {
    board_t *board;
    uint8_t index, mode, temp; /* index 0: timer 1, 1: timer 3 */
    uint16_t count, ocr[3], icr, prescale;
    uint64_t at; /* count is as of this cycle */
} timer16_t;

void timer_init(board_t *board, int index);
void timer_reset(timer16_t *timer);
void timer_event(timer16_t *timer, uint64_t now);
void timer_flags_changed(board_t *board); /* somebody touched TIFR, TIMSK, ETIFR or ETIMSK */

#endif
