/* SPDX-License-Identifier: MIT
 * power.h - the supply and its cuts. */
#ifndef SIM_POWER_H
#define SIM_POWER_H

#include "board.h"

void power_init(board_t *board);

#endif
