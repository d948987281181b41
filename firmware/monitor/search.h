/* SPDX-License-Identifier: MIT
 * search.h - which servos are on the bus. Prints what it finds, kicks the watchdog. Main loop only. RAM: none.
 * An ID that does not answer takes one time-out of bus_call_ping, about a millisecond at 1 Mbps. */
#ifndef SEARCH_H
#define SEARCH_H

#include <stdint.h>

/* IDs 0..last at the present rate of the bus. */
void search_ids(uint8_t last);

/* IDs 0..253 at 57,142 bps and at 1 Mbps. The bus is at 1 Mbps afterwards. */
void search_rates(void);

/* Moves every servo at 57,142 bps to 1 Mbps, one at a time, and searches at 1 Mbps. */
void search_make_fast(void);

#endif
