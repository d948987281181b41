/* SPDX-License-Identifier: MIT
 * search.h - finds the servos on the bus. Prints the result, kicks the watchdog. Main loop only. RAM: none.
 * An ID that does not answer takes one time-out of bus_call_ping, about a millisecond at 1 Mbps. */
#ifndef SEARCH_H
#define SEARCH_H

#include <stdbool.h>
#include <stdint.h>

/* Searches IDs 0..last at the current rate of the bus. An ID with a damaged answer is printed with a question mark. */
void search_ids(uint8_t last);

/* Searches IDs 0..253 at 57,142 bps and at 1 Mbps. Leaves the bus at 1 Mbps. */
void search_rates(void);

/* Whether a servo answers to this ID at this rate. Any byte counts: the answers of two servos with one ID collide, and a
 * loose contact cuts them short. 9 ms if nobody does. Leaves the bus at 1 Mbps. */
bool search_is_there(uint8_t id, uint8_t rate);

/* Moves every servo at 57,142 bps to 1 Mbps, one at a time, and searches at 1 Mbps. Leaves and names those whose ID 1 Mbps
 * already has: two servos with one ID at one rate can only be told apart by unplugging one. Names those that do not obey. */
void search_make_fast(void);

#endif
