/* SPDX-License-Identifier: MIT
 * ports_cm5.h - the CM-5's pins as the loader sets them (BOARD.md) and as it hands them to an application
 * (ORIGINAL.md, section 5). */
#ifndef PORTS_H
#define PORTS_H

#include <avr/io.h>

#define BOOT_BOARD 1 /* app_record.h: CM-5 */
#define PORTS_BOARD_NAME "CM5"

/* While the loader runs, the gate of the PC's line (PD5) is open and that of the radio is closed. The loader does not use
 * the arrows, but has their pull-ups on: a dump of the registers reads their pins. An application starts with them off. */
#define PORTS_OPEN() \
    (DDRB = 0x20, PORTB = 0x20, PORTC = 0x7E, DDRC = 0x77, PORTD = 0x31, DDRD = 0x70, PORTE = 0xF0, DDRE = 0x0C)
#define PORTS_HAND_OVER() (PORTD = 0x51, PORTE = 0x00) /* the rest stays as PORTS_OPEN set them */

#define PORTS_START_PRESSED() (!(PIND & 1 << PD0))

/* The three LEDs of the loader: port C bits 4, 5, 6, low = lit. */
#define PORTS_LEDS_ON() (PORTC &= (uint8_t)~0x70)
#define PORTS_LEDS_OFF() (PORTC |= 0x70)

#endif
