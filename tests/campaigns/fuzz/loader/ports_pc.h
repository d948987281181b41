/* SPDX-License-Identifier: MIT
 * The loader's pins on a PC: a button pressed by the harness, LEDs without effect. */
#ifndef PORTS_H
#define PORTS_H

#include <stdbool.h>

bool loader_start_pressed(void);

#define PORTS_START_PRESSED() loader_start_pressed()
#define PORTS_LEDS_ON() ((void)0)
#define PORTS_LEDS_OFF() ((void)0)

#endif
