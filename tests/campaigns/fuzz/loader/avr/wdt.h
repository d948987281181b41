/* SPDX-License-Identifier: MIT
 * The watchdog for the loader built on a PC: a kick is where a harness sees the main loop turn. */
#ifndef LOADER_WDT_H
#define LOADER_WDT_H

void wdt_reset(void);

#endif
