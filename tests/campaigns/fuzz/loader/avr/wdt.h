/* SPDX-License-Identifier: MIT
 * The watchdog for the loader built on a PC: the harness gets each kick. */
#ifndef LOADER_WDT_H
#define LOADER_WDT_H

void wdt_reset(void);

#endif
