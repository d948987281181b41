/* SPDX-License-Identifier: MIT
 * monitor.h - the prompt: lines in, words out, and the doors to the two binary protocols.
 * What arrives at the prompt is text, but for two beginnings that no word has: 0x30 0x20 at the start of a line (the
 * sync of STK500v1: avrdude) and FRAME_REQUEST (block.h). */
#ifndef MONITOR_H
#define MONITOR_H

#include <stdbool.h>

#define MONITOR_SYNC_1 0x30u
#define MONITOR_SYNC_2 0x20u

/* Never returns. stk500: the sync has been seen already; no banner before that session. */
void monitor_run(bool stk500) __attribute__((noreturn));

#endif
