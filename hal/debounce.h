/* SPDX-License-Identifier: MIT
 * debounce.h - debounces up to eight contacts at once. A change takes effect after several equal samples in a row.
 * Pure; caller-owned; main loop only. */
#ifndef DEBOUNCE_H
#define DEBOUNCE_H

#include <stdint.h>

typedef struct {
    uint8_t steady;   /* the debounced state */
    uint8_t last;     /* the last sample */
    uint8_t seen;     /* consecutive samples equal to it */
} debounce_t;

/* Starts with `now` as the steady state. */
void debounce_init(debounce_t *debounce, uint8_t now);

/* Takes one sample; `needed` equal ones in a row (2..255) make it steady. Returns the steady state. */
uint8_t debounce_sample(debounce_t *debounce, uint8_t sample, uint8_t needed);

#endif
