/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* The SRAM ends at 0x10FF. */
static void NOINLINE store(void)
{
    *(volatile uint8_t *)(WRONG ? 0x1100 : 0x0F00) = 1;
}

int main(void)
{
    console_on();
    store();
    finish();
}
