/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* SPM in the application section: the chip executes it as a NOP. */
static void NOINLINE erase_from_here(void)
{
    boot_page_erase(PAGE);
}

int main(void)
{
    console_on();
    if (WRONG) {
        erase_from_here();
    }
    finish();
}
