/* SPDX-License-Identifier: MIT
 * block.h - the block protocol for our own tool: BLOCK_PROTOCOL.md describes it. */
#ifndef BLOCK_H
#define BLOCK_H

#include "frame.h"

/* Runs a session. The caller has taken the first byte of the first frame. Ends with LEAVE, after 4 s of silence or 1,000
 * bytes without a frame, or at once if the first frame is bad. Afterwards the line runs at 57,143 again. */
void block_session(void);

#endif
