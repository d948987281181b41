/* SPDX-License-Identifier: MIT */

#include "board_private.h"

bool board_gdb(board_t *board, int port, bool wait)
{
    avr_t *avr = board->avr;
    avr->gdb_port = port;
    if (avr_gdb_init(avr) < 0 || !avr->gdb) {
        snprintf(board->error, sizeof board->error, "GDB: port %d cannot be opened", port);
        return false;
    }
    avr->state = wait ? cpu_Stopped : cpu_Running;
    return true;
}
