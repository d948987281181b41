/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Reads the last byte of the busy half, or the first one behind it, with ELPM without operands. */
static uint8_t NOINLINE read_at_the_edge(void)
{
    uint16_t z = WRONG ? 0xDFFF : 0xE000;
    uint8_t value;
    boot_page_erase(PAGE);
    boot_spm_busy_wait();
    RAMPZ = 1;
    __asm__ volatile("elpm\n\tmov %0, r0" : "=r"(value) : "z"(z) : "r0");
    return value;
}

int main(void)
{
    console_on();
    (void)read_at_the_edge();
    finish();
}
