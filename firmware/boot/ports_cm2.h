/* SPDX-License-Identifier: MIT
 * ports_cm2.h - the CM-2 / CM-2+. Only the bus direction pin PE2 is known (BOARD.md), so no other pin is driven: there are
 * no LEDs and no button. PE2 low: the bus is not driven. */
#ifndef PORTS_H
#define PORTS_H

#include <avr/io.h>
#include <stdbool.h>

#define BOOT_BOARD 2 /* app_record.h: CM-2 */
#define PORTS_BOARD_NAME "CM2"

#define PORTS_OPEN() (PORTE = 0x00, DDRE = 0x04)
#define PORTS_HAND_OVER() ((void)0)
#define PORTS_START_PRESSED() false
#define PORTS_LEDS_ON() ((void)0)
#define PORTS_LEDS_OFF() ((void)0)

#endif
