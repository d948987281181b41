/* SPDX-License-Identifier: MIT */
#include "debounce.h"

void debounce_init(debounce_t *debounce, uint8_t now)
{
    debounce->steady = now;
    debounce->last = now;
    debounce->seen = 1;
}

uint8_t debounce_sample(debounce_t *debounce, uint8_t sample, uint8_t needed)
{
    if (sample != debounce->last) {
        debounce->last = sample;
        debounce->seen = 1;
    } else if (debounce->seen < needed && ++debounce->seen == needed) {
        debounce->steady = sample;
    }
    return debounce->steady;
}
