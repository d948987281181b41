/* SPDX-License-Identifier: MIT */
#include "fake_panel.h"
#include "debounce.h"
#include "panel.h"

static uint8_t pressed, lit;
static debounce_t buttons;

void fake_panel_reset(void)
{
    pressed = 0;
    panel_init();
}

void fake_panel_press(uint8_t now)
{
    pressed = now;
}

void panel_init(void)
{
    lit = PANEL_LED_POWER;
    debounce_init(&buttons, panel_buttons_now());
}

void panel_set(uint8_t leds, bool on)
{
    lit = (uint8_t)(on ? lit | leds : lit & (uint8_t)~leds);
}

uint8_t panel_lit(void)
{
    return lit;
}

void panel_tick(void)
{
    debounce_sample(&buttons, panel_buttons_now(), PANEL_STEADY_TICKS);
}

uint8_t panel_buttons(void)
{
    return buttons.steady;
}

uint8_t panel_buttons_now(void)
{
    return pressed;
}
