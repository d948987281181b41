/* SPDX-License-Identifier: MIT
 * vary.h - changes an input at random, without guidance, for samples that have no time for libFuzzer. The same seed
 * gives the same inputs on every machine. */
#ifndef VARY_H
#define VARY_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint8_t *bytes; /* room for size_max of vary() */
    size_t size;
} input_t;

/* Restarts the random numbers; any seed is valid. */
void vary_seed(uint32_t seed);

/* Returns a random number 0..below-1; 0 if below is 0. */
size_t vary_chance(size_t below);

/* Makes one to four changes: bits, bytes, or ranges that are removed, repeated or copied from `other` (another input
 * of the corpus). The input must not be longer than size_max, before and after. */
void vary(input_t *input, size_t size_max, const input_t *other);

#endif
