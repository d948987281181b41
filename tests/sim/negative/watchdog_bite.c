/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* 14 ms without WDR. The test makes a watchdog reset a violation. */
static void NOINLINE work(void)
{
    wdt_enable(WDTO_15MS);
    for (uint16_t i = 0; i < 64000; i++) {
        if (!WRONG) {
            wdt_reset();
        }
        __asm__ volatile("");
    }
    wdt_disable();
}

int main(void)
{
    console_on();
    work();
    finish();
}
