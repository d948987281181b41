/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Starts a second operation during the first. */
static void NOINLINE fill_while_busy(void)
{
    boot_page_erase(PAGE);
    if (!WRONG) {
        boot_spm_busy_wait();
    }
    boot_page_fill(PAGE, 0x1234);
}

int main(void)
{
    console_on();
    fill_while_busy();
    finish();
}
