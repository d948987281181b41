/* SPDX-License-Identifier: MIT
 * inputs_stage.h - fixture for the tests of Play's inputs: a performer that only logs its calls, a remote, and time.
 * Page 2 has code 1, page 5 code 16. Contains setUp and tearDown. */
#ifndef INPUTS_STAGE_H
#define INPUTS_STAGE_H

#include "firmware/play/inputs.h"

extern inputs_t inputs;
extern performer_t performer;
extern page_store_t pages;
extern char told[128];         /* log of the performer's calls: "start 5 16;" */
extern uint8_t start_status;   /* what the performer returns for a start */
extern uint8_t partner;        /* right partner of the playing page; 0: none */

/* Sends a packet of the remote to the inputs. */
void remote(uint16_t buttons);

/* Runs ticks and the main loop between them. */
void ticks(uint8_t count);

#endif
