/* SPDX-License-Identifier: MIT
 * words.h - the words of the prompt and what they do. */
#ifndef WORDS_H
#define WORDS_H

#include "parse.h"

/* Carries out a parsed line with a word. `status` is what parse_line said of its arguments. */
void words_run(const parse_t *line, parse_status_t status);

/* GO: to a word address, or nothing when that is an empty application. */
void words_go(uint16_t word);

#endif
