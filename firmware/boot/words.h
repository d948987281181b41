/* SPDX-License-Identifier: MIT
 * words.h - carries out the words of the prompt. */
#ifndef WORDS_H
#define WORDS_H

#include "parse.h"

#include <stdbool.h>

/* Carries out a parsed line that has a word. `status` is the result of parse_line. */
void words_run(const parse_t *line, parse_status_t status);

/* GO: jumps to a word address. Returns only if that is 0 and the application is absent, or damaged without `force` (the word
 * FORCE). */
void words_go(uint16_t word, bool force);

#endif
