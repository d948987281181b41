/* SPDX-License-Identifier: MIT
 * inputs_stage.h - what the tests of Play's inputs share: a performer that only writes down what it is told, a remote, and
 * time. Page 2 has code 1, page 5 code 16. setUp and tearDown are here. */
#ifndef INPUTS_STAGE_H
#define INPUTS_STAGE_H

#include "firmware/play/inputs.h"

extern inputs_t inputs;
extern performer_t performer;
extern page_store_t pages;
extern settings_t settings;
extern char told[128];         /* what the performer was told: "start 5 16;" */
extern uint8_t start_status;   /* what it answers to a start */
extern uint8_t partner;        /* of the page that plays, to the right; 0: none */

/* The remote sends a packet, which is taken. */
void remote(uint16_t buttons);

/* Ticks, with the main loop going round between them. */
void ticks(uint8_t count);

#endif
