/* SPDX-License-Identifier: MIT */
#include "negative.h"

static volatile uint8_t variables[3000];

/* Each call takes some 20 bytes: 40 calls fit above the variables, 100 do not. */
static uint8_t NOINLINE dig(uint8_t depth)
{
    volatile uint8_t local[10];
    local[0] = depth;
    if (depth) {
        local[1] = dig((uint8_t)(depth - 1));
    }
    return (uint8_t)(local[0] + variables[depth]);
}

int main(void)
{
    console_on();
    put((char)(dig(WRONG ? 100 : 40) & 0x7F));
    finish();
}
