/* SPDX-License-Identifier: MIT
 * pins_cm2.h - the pin assignment of the CM-2 and CM-2+. Selected by BOARD_PINS_H. Only the bus direction is known
 * (BOARD.md, "CM-2 / CM-2+"); the other pins stay as the reset or the loader left them. */
#ifndef PINS_CM2_H
#define PINS_CM2_H

#include <avr/io.h>
#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"

#define PINS_HAVE_PANEL false

/* One direction pin: high = transmit, low = receive. */
#define PINS_BUS_DRIVE (1u << PE2)

ALWAYS_INLINE void pins_bus_drive(void)
{
    PORTE |= PINS_BUS_DRIVE;
}

ALWAYS_INLINE void pins_bus_listen(void)
{
    PORTE &= (uint8_t)~PINS_BUS_DRIVE;
}

static inline void pins_init_bus(void)
{
    pins_bus_listen();
    DDRE |= PINS_BUS_DRIVE;
}

static inline void pins_init_panel(void)
{
}

static inline void pins_set_leds(uint8_t lit)
{
    (void)lit;
}

static inline uint8_t pins_buttons(void)
{
    return 0;
}

#endif
