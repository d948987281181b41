/* SPDX-License-Identifier: MIT
 * text_pairs.h - the dictionary of packed texts, for text.c only. This one is empty, for programs whose texts are not
 * packed (all tests). For an image, tools/dev/pack_texts writes the dictionary into the build folder, next to a copy of
 * text.c, which finds it first. */
#ifndef TEXT_PAIRS_H
#define TEXT_PAIRS_H

#include "pgm.h"

#define TEXT_PAIRS_DEPTH 1u   /* nesting of the pairs */

/* The pairs for 0x80..0xFF, 0x00 (none) and 0x01..0x1F: each byte a character, 0 (the end) or such a code. */
static const uint8_t text_pairs[][2] PROGMEM = { { 0, 0 } };

#endif
