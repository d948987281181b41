/* SPDX-License-Identifier: MIT
 * bus_call.h - the common instructions over bus.h, blocking: for set-up, searches and line monitors.
 * Portable: works on the real bus and on the fake one. Main loop only. No RAM of its own. Each call first waits for the
 * current packet, then blocks at most tries * (time of both packets + return delay + 0.3 ms). */
#ifndef BUS_CALL_H
#define BUS_CALL_H

#include "bus.h"

#define BUS_CALL_TRIES 3u

/* error: the servo's error byte, written only on BUS_OK; may be NULL. */
MUST_CHECK bus_status_t bus_call_ping(uint8_t id, uint8_t tries, uint8_t *error);

/* Reads `count` (1..DXL_ANSWER_PARAMS) bytes from address `at` on. `to` is written only on BUS_OK. */
MUST_CHECK bus_status_t bus_call_read(uint8_t id, uint8_t at, void *to, uint8_t count, uint8_t *error);

/* Any instruction with any parameters (line monitor). answer_params as in bus_submit; *answer may be NULL. */
bus_status_t bus_call(uint8_t id, uint8_t instruction, const uint8_t *params, uint8_t count, uint8_t answer_params,
                      uint8_t tries, bus_answer_t *answer);

/* Starts a READ and returns at once (BUS_PENDING or BUS_ERR_BUSY); bus_poll returns the answer. */
bus_status_t bus_start_read(uint8_t id, uint8_t at, uint8_t count, uint8_t tries);

#endif
