/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* 14 ms without WDR: to write WDTCR is not enough. The test makes a watchdog reset a violation. */
static void NOINLINE work(void)
{
    wdt_enable(WDTO_15MS);
    for (uint16_t i = 0; i < 64000; i++) {
        if (WRONG) {
            WDTCR = _BV(WDE);
        } else {
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
