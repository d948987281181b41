/* SPDX-License-Identifier: MIT */
#include "fake_panel.h"
#include "debounce.h"
#include "panel.h"

static bool there;
static uint8_t pressed, lit;
static debounce_t buttons;

void fake_panel_reset(void)
{
    there = true;
    pressed = 0;
    panel_init();
}

void fake_panel_press(uint8_t now)
{
    pressed = now;
}

void fake_panel_set_there(bool is_there)
{
    there = is_there;
    panel_init();
}

void panel_init(void)
{
    lit = there ? PANEL_LED_POWER : 0;
    debounce_init(&buttons, panel_buttons_now());
}

void panel_set(uint8_t leds, bool on)
{
    if (there) {
        lit = (uint8_t)(on ? lit | leds : lit & (uint8_t)~leds);
    }
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
    return there ? pressed : 0;
}
