/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* A word of the page buffer can be filled once; then the buffer must be written or discarded. */
static void NOINLINE fill_twice(void)
{
    boot_page_fill(PAGE, 0x1234);
    if (!WRONG) {
        boot_rww_enable(); /* discards the buffer */
    }
    boot_page_fill(PAGE, 0x4321);
}

int main(void)
{
    console_on();
    fill_twice();
    finish();
}
