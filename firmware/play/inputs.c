/* SPDX-License-Identifier: MIT */
#include "inputs.h"

#include <string.h>
#include "console.h"
#include "panel.h"

#define TYPED_XOFF 48u    /* typed bytes waiting that cause XOFF; 80 more still fit */
#define TYPED_XON 16u

void inputs_init(inputs_t *inputs, performer_t *performer, const page_store_t *pages, const settings_t *settings)
{
    memset(inputs, 0, sizeof *inputs);
    inputs->performer = performer;
    inputs->pages = pages;
    inputs->settings = settings;
    inputs->silent_ticks = INPUTS_SILENCE_TICKS;
    remote_init(&inputs->remote);
    ring_init(&inputs->typed, inputs->typed_bytes, INPUTS_TYPED_BYTES);
}

/* ---- codes ---- */

static void refuse(inputs_t *inputs, const inputs_refusal_t *refusal)
{
    inputs->refusal = *refusal;
    inputs->refused = true;
}

static void call(inputs_t *inputs, uint8_t code, bool held)
{
    inputs_refusal_t refusal = {.code = code};
    refusal.page = page_store_find_code(inputs->pages, code);
    refusal.no_page = refusal.page == 0;
    if (!refusal.no_page) {
        refusal.status = (uint8_t)performer_start(inputs->performer, refusal.page, code);
        refusal.page = inputs->performer->fault_page;
        refusal.fault = inputs->performer->fault;
    }
    if ((refusal.no_page || refusal.status != PERFORMER_OK) && !held) {
        refuse(inputs, &refusal);
    }
}

void inputs_code(inputs_t *inputs, uint8_t code)
{
    const bool held = code == inputs->code;
    inputs->code = code;
    if (!performer_is_idle(inputs->performer)) {
        performer_code(inputs->performer, code);
    } else if (code != LINK_CODE_NONE && code != LINK_CODE_STOP) {
        call(inputs, code, held);
    }
}

void inputs_pause(inputs_t *inputs)
{
    if (!performer_pause(inputs->performer)) {
        (void)performer_resume(inputs->performer);
    }
}

bool inputs_next_refusal(inputs_t *inputs, inputs_refusal_t *refusal)
{
    if (!inputs->refused) {
        return false;
    }
    inputs->refused = false;
    *refusal = inputs->refusal;
    return true;
}

/* Whether L and R steer, and are no part of the code. NOINLINE: it would be copied twice. */
static NOINLINE bool steers(const inputs_t *inputs)
{
    return inputs->settings->remote_mode == SETTINGS_REMOTE_DRIVE && steer_is_possible(inputs->performer);
}

/* A remote repeats its packet while buttons are down. Stop and pause act once, when they are pressed. Codes act with every
 * packet, so that a lost one does not matter. */
static void take_packet(inputs_t *inputs)
{
    const uint16_t buttons = inputs->remote.buttons;
    uint8_t code;
    const uint8_t act_before = inputs->remote_act;
    const uint8_t act = (uint8_t)remote_act(buttons, &code);
    inputs->remote_act = act;
    inputs->remote_buttons = (uint8_t)buttons;
    inputs->silent_ticks = buttons == 0 ? INPUTS_SILENCE_TICKS : 0;
    if (act == REMOTE_ACT_CODE) {
        inputs_code(inputs, steers(inputs) ? (uint8_t)(code & ~(REMOTE_LEFT | REMOTE_RIGHT)) : code);
    } else if (act != act_before) {
        if (act == REMOTE_ACT_STOP) {
            inputs_code(inputs, LINK_CODE_STOP);
        } else {
            inputs_pause(inputs);
        }
    }
}

/* ---- bytes ---- */

static void keep_typed(inputs_t *inputs)
{
    for (uint8_t i = 0; i < inputs->remote.text_count; i++) {
        if (!ring_put(&inputs->typed, inputs->remote.text[i]) && inputs->lost < INPUTS_LOST_MAX) {
            inputs->lost++;
        }
    }
}

static void control_flow(inputs_t *inputs)
{
    const uint8_t waiting = ring_count(&inputs->typed);
    if (!inputs->pc_waits && waiting >= TYPED_XOFF) {
        inputs->pc_waits = true;
        console_xoff();
    } else if (inputs->pc_waits && waiting <= TYPED_XON) {
        inputs->pc_waits = false;
        console_xon();
    }
}

void inputs_take(inputs_t *inputs)
{
    uint8_t byte;
    while (console_get(&byte)) {
        inputs->quiet_ticks = 0;
        switch (remote_byte(&inputs->remote, byte)) {
        case REMOTE_PACKET:
            take_packet(inputs);
            break;
        case REMOTE_TEXT:
            keep_typed(inputs);
            break;
        default:
            break;
        }
    }
    control_flow(inputs);
}

bool inputs_get(inputs_t *inputs, uint8_t *byte)
{
    return ring_get(&inputs->typed, byte);
}

/* ---- time ---- */

static void take_panel(inputs_t *inputs)
{
    const uint8_t buttons = panel_buttons();
    if (!inputs->panel_was_free) {
        inputs->panel_was_free = buttons == 0 && panel_buttons_now() == 0;
        return;
    }
    const uint8_t changed = buttons ^ inputs->panel_buttons;
    inputs->panel_buttons = buttons;
    if ((changed & PANEL_ARROWS) != 0) {
        inputs_code(inputs, buttons & PANEL_ARROWS);
    }
    if ((changed & buttons & PANEL_START) != 0) {
        inputs_code(inputs, LINK_CODE_STOP);
    }
}

static void steer(inputs_t *inputs)
{
    const uint8_t held = inputs->remote_buttons;
    const int8_t direction = (int8_t)(((held & REMOTE_RIGHT) != 0) - ((held & REMOTE_LEFT) != 0));
    steer_tick(&inputs->steer, inputs->performer, direction != 0 && steers(inputs) ? direction : 0);
}

void inputs_tick(inputs_t *inputs)
{
    take_panel(inputs);
    steer(inputs);
    if (inputs->quiet_ticks < INPUTS_QUIET_TICKS && ++inputs->quiet_ticks == INPUTS_QUIET_TICKS) {
        if (remote_quiet(&inputs->remote) == REMOTE_TEXT) {
            keep_typed(inputs);
        }
    }
    if (inputs->silent_ticks < INPUTS_SILENCE_TICKS && ++inputs->silent_ticks == INPUTS_SILENCE_TICKS) {
        inputs->remote_act = REMOTE_ACT_CODE;
        inputs->remote_buttons = 0;
        if (inputs->settings->remote_mode == LINK_HOLD && inputs->code != LINK_CODE_NONE) {
            inputs_code(inputs, LINK_CODE_NONE);
        }
    }
}
