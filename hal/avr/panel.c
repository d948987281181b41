/* SPDX-License-Identifier: MIT */
#include "panel.h"
#include "debounce.h"

#include BOARD_PINS_H

static uint8_t lit;
static debounce_t buttons;

void panel_init(void)
{
    pins_init_panel();
    lit = PINS_HAVE_PANEL ? PANEL_LED_POWER : 0;
    pins_set_leds(lit);
    /* Starts with all buttons up, because the pull-ups need time to settle. */
    debounce_init(&buttons, 0);
}

void panel_set(uint8_t leds, bool on)
{
    if (PINS_HAVE_PANEL) {
        lit = on ? lit | leds : lit & ~leds;
        pins_set_leds(lit);
    }
}

uint8_t panel_lit(void)
{
    return lit;
}

void panel_tick(void)
{
    if (PINS_HAVE_PANEL) {
        (void)debounce_sample(&buttons, pins_buttons(), PANEL_STEADY_TICKS);
    }
}

uint8_t panel_buttons(void)
{
    return buttons.steady;
}

uint8_t panel_buttons_now(void)
{
    return pins_buttons();
}
