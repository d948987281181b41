/* SPDX-License-Identifier: MIT
 * vary.h - changes an input by chance, blindly: what a sample does, which has no time for libFuzzer. The same seed gives
 * the same inputs on every machine. */
#ifndef VARY_H
#define VARY_H

#include <stddef.h>
#include <stdint.h>

typedef struct {
    uint8_t *bytes; /* room for size_max of vary() */
    size_t size;
} input_t;

/* Begins anew; any seed will do. */
void vary_seed(uint32_t seed);

/* 0..below-1 by chance; below 0 gives 0. */
size_t vary_chance(size_t below);

/* One to four changes: bits, bytes, ranges that go, come twice or come from `other` (another input of the corpus). The
 * input must not be longer than size_max, and is not afterwards. */
void vary(input_t *input, size_t size_max, const input_t *other);

#endif
