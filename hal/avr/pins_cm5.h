/* SPDX-License-Identifier: MIT
 * pins_cm5.h - the pin assignment of the CM-5. Selected by BOARD_PINS_H. Source: BOARD.md, "CM-5 pins". */
#ifndef PINS_CM5_H
#define PINS_CM5_H

#include <avr/io.h>
#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"

#define PINS_HAVE_PANEL true

/* PC0-PC6: lamps, low = lit, in the order of PANEL_LED_. */
#define PINS_LEDS 0x7Fu
/* PE4-PE7: Up Down Left Right; PD0: Start; to ground, pull-ups on. */
#define PINS_ARROWS_SHIFT 4u
#define PINS_START (1u << PD0)

#define PINS_BUS_DRIVE (1u << PE2)
#define PINS_BUS_LISTEN (1u << PE3)
#define PINS_CHARGER_OFF (1u << PB5)
#define PINS_ZIGBEE_RUN (1u << PD4)
#define PINS_GATE_PC (1u << PD5)
#define PINS_GATE_REMOTE (1u << PD6)

/* The bus transceiver: PE2 drives the line, PE3 listens to it, never both. Single-bit writes to port E are atomic (SBI,
 * CBI), so both main loop and ISR may call these. */
ALWAYS_INLINE void pins_bus_drive(void)
{
    PORTE &= (uint8_t)~PINS_BUS_LISTEN;
    PORTE |= PINS_BUS_DRIVE;
}

ALWAYS_INLINE void pins_bus_listen(void)
{
    PORTE &= (uint8_t)~PINS_BUS_DRIVE;
    PORTE |= PINS_BUS_LISTEN;
}

static inline void pins_init_bus(void)
{
    pins_bus_listen();
    DDRE |= PINS_BUS_DRIVE | PINS_BUS_LISTEN;
}

/* Sets levels before directions, so that no pin glitches. */
static inline void pins_init_panel(void)
{
    PORTB |= PINS_CHARGER_OFF;
    DDRB |= PINS_CHARGER_OFF;
    PORTC = 0xFE;   /* all off except Power; pull-up on the unused pin */
    DDRC = PINS_LEDS;
    PORTD |= PINS_START | PINS_ZIGBEE_RUN | PINS_GATE_PC | PINS_GATE_REMOTE;
    DDRD = (uint8_t)((DDRD & ~PINS_START) | PINS_ZIGBEE_RUN | PINS_GATE_PC | PINS_GATE_REMOTE);
    PORTE |= 0xF0;
    DDRE &= 0x0F;
}

static inline void pins_set_leds(uint8_t lit)
{
    PORTC = (uint8_t)~lit;
}

/* Bits as PANEL_UP .. PANEL_START, 1 = pressed. */
static inline uint8_t pins_buttons(void)
{
    uint8_t arrows = (uint8_t)((uint8_t)~PINE >> PINS_ARROWS_SHIFT);
    return (uint8_t)(arrows | (PIND & PINS_START ? 0u : 0x10u));
}

#endif
