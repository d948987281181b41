/* SPDX-License-Identifier: MIT
 * panel.c - panel.h: keys act as buttons; lamps are stored but not shown. */
#include "panel.h"

#include "debounce.h"
#include "machine.h"

static uint8_t lamps;
static debounce_t buttons;

void panel_init(void)
{
    lamps = PANEL_LED_POWER;
    debounce_init(&buttons, 0);
}

void panel_set(uint8_t leds, bool on)
{
    lamps = (uint8_t)(on ? lamps | leds : lamps & (uint8_t)~leds);
}

uint8_t panel_lit(void)
{
    return lamps;
}

void panel_tick(void)
{
    (void)debounce_sample(&buttons, machine_buttons(), PANEL_STEADY_TICKS);
}

uint8_t panel_buttons(void)
{
    return buttons.steady;
}

uint8_t panel_buttons_now(void)
{
    return machine_buttons();
}
