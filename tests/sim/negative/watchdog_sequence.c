/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* Stops the watchdog with a plain write: the chip keeps counting. */
static void NOINLINE stop_watchdog(void)
{
    wdt_enable(WDTO_500MS);
    if (WRONG) {
        WDTCR = 0;
    } else {
        wdt_disable();
    }
}

int main(void)
{
    console_on();
    stop_watchdog();
    finish();
}
