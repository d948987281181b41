/* SPDX-License-Identifier: MIT
 * prompt.h - reads lines and runs their words; starts the two binary protocols.
 * Two sequences start a protocol instead of a word: 0x30 0x20 at the start of a line (the sync of STK500v1: avrdude) and
 * FRAME_REQUEST (block.h). */
#ifndef PROMPT_H
#define PROMPT_H

#include <stdbool.h>

#define PROMPT_SYNC_1 0x30u
#define PROMPT_SYNC_2 0x20u

/* Never returns. stk500: the sync was already received, so the session starts at once, without a banner. */
void prompt_run(bool stk500) __attribute__((noreturn));

#endif
