/* SPDX-License-Identifier: MIT */
#include "inputs.h"

#include <string.h>
#include "console.h"
#include "panel.h"

#define TYPED_XOFF 48u    /* typed bytes waiting that cause XOFF; 80 more still fit */
#define TYPED_XON 16u
enum { AT_STOP = 8, AT_PAUSE };   /* in recent_ticks, behind the eight buttons */

void inputs_init(inputs_t *inputs, performer_t *performer, const page_store_t *pages)
{
    memset(inputs, 0, sizeof *inputs);
    inputs->performer = performer;
    inputs->pages = pages;
    inputs->remote_held.spent = UINT8_MAX;   /* a button already held is not a press */
    remote_init(&inputs->remote);
    ring_init(&inputs->typed, inputs->typed_bytes, INPUTS_TYPED_BYTES);
}

/* ---- codes ---- */

static void call(inputs_t *inputs, uint8_t code)
{
    inputs_refusal_t refusal = {.code = code};
    refusal.page = page_store_find_code(inputs->pages, code);
    refusal.no_page = refusal.page == 0;
    if (!refusal.no_page) {
        refusal.status = performer_start(inputs->performer, refusal.page, code);
        refusal.page = inputs->performer->fault_page;
        refusal.fault = inputs->performer->fault;
    }
    if (refusal.no_page || refusal.status != PERFORMER_OK) {
        inputs->refusal = refusal;
        inputs->refused = true;
    }
}

void inputs_code(inputs_t *inputs, uint8_t code)
{
    if (!performer_is_idle(inputs->performer)) {
        performer_code(inputs->performer, code);
    } else if (code == LINK_CODE_STOP) {
        performer_stop(inputs->performer);   /* stops joints moved by code */
    } else if (code != LINK_CODE_NONE) {
        call(inputs, code);
    }
}

/* Whether a play in hold mode has heard of no button yet. Then only a press counts: neither the repeated code of a button
 * that was down before a typed play, nor its release. */
static bool awaits_press(const link_t *link)
{
    return link->mode == LINK_HOLD && link->held_code == LINK_CODE_NONE;
}

static bool stop_is_held(const inputs_t *inputs)
{
    return inputs->recent_ticks[AT_STOP] != 0;
}

static uint8_t held(const inputs_held_t *hand)
{
    return hand->down | hand->recent;
}

/* The buttons that are held during a play or a stop are spent, on every device. Call before a change of the buttons is
 * taken, and in every turn of the main loop. */
static void spend_buttons(inputs_t *inputs)
{
    if (!performer_is_idle(inputs->performer) || performer_was_just_stopped(inputs->performer) || stop_is_held(inputs)) {
        inputs->remote_held.spent |= held(&inputs->remote_held);
        inputs->panel_held.spent |= held(&inputs->panel_held);
    }
}

/* Takes the buttons that a source holds now. */
static void change(inputs_t *inputs, inputs_held_t *hand, uint8_t down)
{
    spend_buttons(inputs);
    hand->down = down;
    hand->spent &= held(hand);
}

/* down: the buttons that a source holds now. code: their code. A running play takes every code. A play starts only on a
 * press: the buttons have changed, and one of them was up during the last play or stop. So a held button, or a chord that
 * is released finger by finger, does not restart a stopped play or revive one that is stopping. */
static void take_buttons(inputs_t *inputs, inputs_held_t *hand, uint8_t down, uint8_t code)
{
    const bool have_changed = down != hand->down;
    change(inputs, hand, down);
    const bool are_new = (down & ~hand->spent) != 0 && !stop_is_held(inputs);
    const bool pressed = have_changed && are_new;
    const link_t *link = &inputs->performer->link;
    const bool is_heard = awaits_press(link) ? pressed : down == 0 || are_new || !link_is_stopping(link);
    if (performer_is_idle(inputs->performer) ? pressed : is_heard) {
        inputs_code(inputs, code);
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

/* Whether L and R steer the present play, once it has begun, instead of being part of the code. */
static bool steers(const inputs_t *inputs)
{
    return inputs->performer->link.mode == LINK_DRIVE && steer_is_possible(inputs->performer);
}

/* Stop or pause. It counts once, when pressed. was_empty: the packet before had no button. Behind one a stop counts at once:
 * two quick ones are a break. */
static void take_act(inputs_t *inputs, uint8_t act, bool has_changed, bool was_empty)
{
    uint8_t *recent_ticks = &inputs->recent_ticks[act == REMOTE_ACT_STOP ? AT_STOP : AT_PAUSE];
    if (has_changed && (*recent_ticks == 0 || (was_empty && act == REMOTE_ACT_STOP))) {
        if (act == REMOTE_ACT_STOP) {
            inputs_code(inputs, LINK_CODE_STOP);
        } else {
            inputs_pause(inputs);
        }
    }
    *recent_ticks = INPUTS_RELEASE_TICKS;
}

/* A remote repeats its packet while buttons are down. Codes reach a play with every packet, so that a lost packet does not
 * matter. */
static void take_packet(inputs_t *inputs)
{
    const uint16_t buttons = inputs->remote.buttons;
    const uint8_t down = (uint8_t)buttons;
    uint8_t code;
    const uint8_t act_before = inputs->remote_act;
    const bool was_empty = act_before == REMOTE_ACT_CODE && inputs->remote_held.down == 0;
    const uint8_t act = remote_act(buttons, &code);
    inputs->remote_act = act;
    inputs->silent_ticks = buttons == 0 ? INPUTS_SILENCE_TICKS : 0;
    if (act == REMOTE_ACT_CODE) {
        take_buttons(inputs, &inputs->remote_held, down,
                     steers(inputs) ? (uint8_t)(code & ~(REMOTE_LEFT | REMOTE_RIGHT)) : code);
    } else {
        change(inputs, &inputs->remote_held, down);
        take_act(inputs, act, act != act_before, was_empty);
    }
    inputs->remote_held.recent |= down;
    for (uint8_t i = 0, rest = down; rest != 0; i++, rest >>= 1) {
        if ((rest & 1u) != 0) {
            inputs->recent_ticks[i] = INPUTS_RELEASE_TICKS;
        }
    }
}

/* ---- bytes ---- */

static void note_hole(inputs_t *inputs, uint8_t count)
{
    inputs->holes = (uint8_t)(inputs->holes > INPUTS_HOLE_MAX - count ? INPUTS_HOLE_MAX : inputs->holes + count);
}

/* Queues a typed byte, preceded by the number of bytes lost before it. */
static void keep(inputs_t *inputs, uint8_t byte)
{
    if (inputs->holes != 0 && ring_room(&inputs->typed) >= 2u) {
        (void)ring_put(&inputs->typed, (uint8_t)(INPUTS_HOLE | inputs->holes));
        inputs->holes = 0;
    }
    if (inputs->holes != 0 || !ring_put(&inputs->typed, byte)) {
        note_hole(inputs, 1);
        inputs->lost = (uint16_t)(inputs->lost + (inputs->lost < INPUTS_LOST_MAX ? 1 : 0));
    }
}

static void keep_typed(inputs_t *inputs)
{
    for (uint8_t i = 0; i < inputs->remote.text_count; i++) {
        keep(inputs, inputs->remote.text[i]);
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
        const uint8_t lost = console_lost();
        note_hole(inputs, lost < INPUTS_HOLE_MAX ? lost : INPUTS_HOLE_MAX);
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
    spend_buttons(inputs);
    control_flow(inputs);
}

bool inputs_get(inputs_t *inputs, uint8_t *byte)
{
    return ring_get(&inputs->typed, byte);
}

/* ---- time ---- */

/* START counts once it was up itself: a jammed arrow must not take away the stop. */
static void take_panel(inputs_t *inputs)
{
    const uint8_t down = panel_buttons() | panel_buttons_now();
    inputs->panel_heard |= down == 0 ? PANEL_ARROWS | PANEL_START : (uint8_t)~down & PANEL_START;
    const uint8_t buttons = panel_buttons() & inputs->panel_heard;
    const uint8_t changed = buttons ^ inputs->panel_buttons;
    inputs->panel_buttons = buttons;
    const uint8_t arrows = buttons & PANEL_ARROWS;
    if ((changed & PANEL_ARROWS) != 0) {
        take_buttons(inputs, &inputs->panel_held, arrows, arrows);
    }
    if ((changed & buttons & PANEL_START) != 0) {
        inputs_code(inputs, LINK_CODE_STOP);
    }
}

static void steer(inputs_t *inputs)
{
    const uint8_t down = inputs->remote_held.down;
    const int8_t direction = (int8_t)(((down & REMOTE_RIGHT) != 0) - ((down & REMOTE_LEFT) != 0));
    const bool is_on = direction != 0 && inputs->performer->state == PERFORMER_PLAY && steers(inputs);
    steer_tick(&inputs->steer, inputs->performer, is_on ? direction : 0);
}

static void age_buttons(inputs_t *inputs)
{
    inputs_held_t *hand = &inputs->remote_held;
    uint8_t bit = 1;   /* 0 for stop and pause */
    for (uint8_t i = 0; i < sizeof inputs->recent_ticks; i++, bit = (uint8_t)(bit << 1)) {
        if (inputs->recent_ticks[i] != 0 && --inputs->recent_ticks[i] == 0) {
            hand->recent &= (uint8_t)~bit;
            hand->spent &= (uint8_t)(hand->down | ~bit);
        }
    }
}

void inputs_tick(inputs_t *inputs)
{
    age_buttons(inputs);
    take_panel(inputs);
    steer(inputs);
    if (inputs->quiet_ticks < INPUTS_ESC_TICKS && ++inputs->quiet_ticks == INPUTS_QUIET_TICKS) {
        if (remote_quiet(&inputs->remote) == REMOTE_TEXT) {
            keep_typed(inputs);
        }
    }
    if (inputs->silent_ticks < INPUTS_SILENCE_TICKS && ++inputs->silent_ticks == INPUTS_SILENCE_TICKS) {
        const bool was_held = inputs->remote_act != REMOTE_ACT_CODE || inputs->remote_held.down != 0;
        inputs->remote_act = REMOTE_ACT_CODE;
        inputs->remote_held.down = 0;
        inputs->remote_held.spent = 0;
        const link_t *link = &inputs->performer->link;
        if (was_held && link->mode == LINK_HOLD && link->held_code != LINK_CODE_NONE) {
            inputs_code(inputs, LINK_CODE_NONE);
        }
    }
}
