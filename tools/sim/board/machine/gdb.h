/* SPDX-License-Identifier: MIT
 * gdb.h - simavr's GDB server, reachable from this computer only. */
#ifndef SIM_GDB_H
#define SIM_GDB_H

#include <simavr/sim_avr.h>
#include <stdbool.h>

/* Serves on 127.0.0.1:port. If wait is true, the next run waits for GDB. false: the port cannot be opened. */
bool gdb_start(avr_t *avr, int port, bool wait);

#endif
