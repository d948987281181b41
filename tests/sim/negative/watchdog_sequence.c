/* SPDX-License-Identifier: MIT */
#include "negative.h"

/* The watchdog stopped by a plain write: the chip goes on counting. */
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
