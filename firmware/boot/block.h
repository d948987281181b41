/* SPDX-License-Identifier: MIT
 * block.h - the block protocol for our own tool: PROTOCOL.md beside this file is its description. */
#ifndef BLOCK_H
#define BLOCK_H

#include "frame.h"

/* Runs from a frame's first byte (already taken) until LEAVE or 4 s without a good frame; a first frame that is not
 * good ends it at once. The line is back at 57,143 afterwards. */
void block_session(void);

#endif
