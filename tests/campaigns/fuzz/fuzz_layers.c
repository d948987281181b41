/* SPDX-License-Identifier: MIT
 * A shaped main play with a page layer and motion by code over it, on any pages, with every call of layers.h and
 * shape.h at any tick. The same play also runs without layers. Joints that were never lent must move identically, in
 * the same time. The rules are in layers_rules.h, and for each play in step_rules.h.
 *
 * Input: options, hand-over speed, joints present; the pages (fuzz_pages.h), two of which get partners; then events:
 * an action, its arguments, and the number of ticks after it. */
#include "fuzz_pages.h"
#include "layers_rules.h"
#include "step_rules.h"
#include "trap.h"

#include <string.h>

#define TICKS_MAX 1200u
#define BREAK_TICKS 300u   /* the longest ramp is 255 */
#define ALL 0x7FFFFFFFu

static layers_run_t run;
static step_rules_t rules_of_main, rules_of_layer;
static link_mode_t mode;
static unsigned ticks_left;
static bool broken;

/* ---- time ---- */

static uint8_t tick_alone(void)
{
    const uint8_t events = player_tick(&run.alone.player, &run.alone.link);   /* plans by itself */
    if ((events & PLAYER_EV_OUTPUT) != 0) {
        player_goals(&run.alone.player, UINT32_MAX, run.alone.goal_pos);
    }
    return events;
}

static uint8_t tick_laid(uint8_t *of_layer)
{
    const bool is_bound = run.layers.main != NULL, is_laid = player_is_moving(&run.layers.play);
    layers_plan(&run.layers, &run.laid.link);
    if (is_bound) {
        step_rules_before(&rules_of_main, &run.laid.player);
    }
    if (is_laid) {
        step_rules_before(&rules_of_layer, &run.layers.play);
    }
    const uint8_t events = layers_tick(&run.layers, &run.laid.link, of_layer);
    if (is_bound) {
        step_rules_behind(&rules_of_main, &run.laid.player, events);
    }
    if (is_laid) {
        step_rules_behind(&rules_of_layer, &run.layers.play, *of_layer);
    }
    return events;
}

static void disturb(void)
{
    step_rules_disturb(&rules_of_main);
    step_rules_disturb(&rules_of_layer);
}

/* Ends the play as the performer does. */
static void ended(void)
{
    layers_bind(&run.layers, NULL);
    if (broken) {
        layers_break(&run.layers);
    }
}

static void tick(void)
{
    before_t before;
    uint8_t of_layer;
    ticks_left--;
    remember(&run, &before);
    const bool bound = run.layers.main != NULL;
    const uint8_t events = tick_laid(&of_layer);
    const uint8_t events_alone = bound ? tick_alone() : events;
    ASSERT(events == events_alone && (bound || events == 0));
    must_move_well(&run, &before, (of_layer & PLAYER_EV_ENDED) != 0);
    if (bound) {
        must_be_equal(&run);
    }
    if ((events & PLAYER_EV_ENDED) != 0) {
        ended();
    }
    must_be_sane(&run);
}

/* ---- the main play ---- */

static void call(void)
{
    link_init(&run.laid.link, mode);
    link_call(&run.laid.link, 0);
    run.alone.link = run.laid.link;
}

static player_status_t start_one(play_t *play, uint8_t number)
{
    player_init(&play->player, &fuzz_pages_source, play->joint);
    play->player.shape = &run.shape;
    if (play == &run.laid) {
        layers_bind(&run.layers, &run.laid.player);
    }
    return player_start(&play->player, &play->link, number, run.law, run.laid.goal_pos, run.present);
}

static void start(uint8_t number)
{
    if (run.layers.main != NULL) {
        return;
    }
    call();
    memset(run.laid.joint, 0, sizeof run.laid.joint);   /* the approach used this memory */
    const player_status_t status = start_one(&run.alone, number);
    ASSERT(start_one(&run.laid, number) == status);
    memset(&rules_of_main, 0, sizeof rules_of_main);
    if (status != PLAYER_OK) {
        layers_bind(&run.layers, NULL);
        return;
    }
    memcpy(run.alone.goal_pos, run.laid.goal_pos, sizeof run.alone.goal_pos);
    broken = false;
}

static void drop(uint32_t joints)
{
    layers_drop_joints(&run.layers, joints);
    if (run.layers.main != NULL) {
        player_drop_joints(&run.laid.player, joints);
        player_drop_joints(&run.alone.player, joints);
    }
}

static void pause(void)
{
    if (run.layers.main == NULL || player_is_paused(&run.laid.player) || broken) {
        return;
    }
    disturb();
    layers_pause(&run.layers);
    player_pause(&run.laid.player);
    player_pause(&run.alone.player);
}

static void resume(void)
{
    if (run.layers.main == NULL || !player_is_paused(&run.laid.player)) {
        return;
    }
    layers_resume(&run.layers);
    player_resume(&run.laid.player);
    player_resume(&run.alone.player);
}

static void break_off(void)
{
    disturb();
    broken = true;
    layers_break(&run.layers);
    if (run.layers.main != NULL) {
        player_break(&run.laid.player);
        player_break(&run.alone.player);
    }
}

/* ---- layers ---- */

static void lay(uint8_t page, uint32_t joints)
{
    const layers_t old = run.layers;
    const play_t old_laid = run.laid;
    const bool of_first_step = joints == 0;
    const layers_status_t status = layers_start(&run.layers, page, joints);
    if (status == LAYERS_OK) {
        ASSERT(run.layers.main != NULL && page >= 1 && page <= FUZZ_PAGES && page_check(fuzz_pages[page]) == PAGE_OK);
        ASSERT((run.layers.play.present & ~run.laid.player.present) == 0 && run.layers.play.present != 0);
        ASSERT(of_first_step || (run.layers.play.present & ~joints) == 0);
        memset(&rules_of_layer, 0, sizeof rules_of_layer);
        return;
    }
    run.layers.play.fault = old.play.fault;
    run.layers.play.fault_page = old.play.fault_page;
    ASSERT(memcmp(&run.layers, &old, sizeof run.layers) == 0 && memcmp(&run.laid, &old_laid, sizeof run.laid) == 0);
}

/* Moves a joint by code: aim (amplitude 0, with its own speed) or swing. */
static void move_by_code(fuzz_t *fuzz, bool swings)
{
    uint8_t id = fuzz_byte(fuzz) % PAGE_JOINTS;
    /* Without a play the caller must pass a present joint. */
    id = run.layers.main != NULL || has(run.present, id) ? id : 0;
    const uint16_t pos = fuzz_word(fuzz) & PAGE_POS_MAX;
    const uint16_t amount = fuzz_byte(fuzz) % 181u, period = swings ? fuzz_word(fuzz) : 0;
    const layers_t old = run.layers;
    const play_t old_laid = run.laid;
    const uint16_t phase = (uint16_t)(period * 7u % 360u);
    if (swings && !code_motion_can_swing(pos, amount, period)) {
        return;
    }
    const layers_status_t status = swings ? layers_swing(&run.layers, id, pos, amount, period, phase)
                                          : layers_aim(&run.layers, id, pos, (uint16_t)(amount * 2u));
    if (status == LAYERS_OK) {
        ASSERT(has(run.layers.code.joints, id));
        run.code_deg_s[id] = swings || amount == 0 ? run.hand_over_deg_s : (unsigned)amount << 1;
        return;
    }
    ASSERT(memcmp(&run.layers, &old, sizeof run.layers) == 0 && memcmp(&run.laid, &old_laid, sizeof run.laid) == 0);
}

static void set_speed(uint16_t deg_s)
{
    deg_s = deg_s % 361u;
    layers_set_speed(&run.layers, deg_s);
    run.hand_over_deg_s = deg_s != 0 ? deg_s : LAYERS_SPEED_DEFAULT_DEG_S;
}

/* ---- shape ---- */

static void set_shape(fuzz_t *fuzz)
{
    const uint8_t what = fuzz_byte(fuzz);
    const uint16_t value = fuzz_word(fuzz) & 0x1FF;
    switch (what & 7) {
    case 0: run.shape.rate_percent = (uint16_t)(SHAPE_RATE_MIN + value % (SHAPE_RATE_MAX - SHAPE_RATE_MIN + 1u)); break;
    case 1: shape_set_amplitude(&run.shape, (uint8_t)(value % (SHAPE_AMPLITUDE_MAX + 1u)), ALL); break;
    case 2: shape_set_amplitude(&run.shape, (uint8_t)(value % (SHAPE_AMPLITUDE_MAX + 1u)), bit(what >> 3)); break;
    case 3: run.shape.blend_percent = (int8_t)(value % (2u * SHAPE_BLEND_MAX + 1u) - SHAPE_BLEND_MAX); break;
    case 4: run.shape.centre_page = (uint8_t)value; break;
    case 5: shape_set_voltage(&run.shape, (uint8_t)value); break;
    case 6: shape_reset(&run.shape); break;
    default: break;
    }
}

/* ---- an input ---- */

static uint32_t mask(fuzz_t *fuzz)
{
    const uint16_t word = fuzz_word(fuzz);   /* the pages move joints 0, 1, 17 and 30 */
    return ((uint32_t)(word & 0x4003) << 16 | word) & ALL;
}

static void to_link(uint8_t code)
{
    if (code == 0xFF) {
        link_stop(&run.laid.link);
    } else {
        link_code(&run.laid.link, code);
    }
    run.alone.link = run.laid.link;
}

static void lay_on_joints(fuzz_t *fuzz)
{
    const uint8_t page = (uint8_t)(1 + fuzz_byte(fuzz) % FUZZ_PAGES);   /* evaluated first with any compiler */
    lay(page, mask(fuzz));
}

static void act(fuzz_t *fuzz)
{
    switch (fuzz_byte(fuzz) & 15) {
    case 0: break;
    case 1: to_link(fuzz_byte(fuzz)); break;
    case 2: break_off(); break;
    case 3: pause(); break;
    case 4: resume(); break;
    case 5: drop(bit(fuzz_byte(fuzz) % PAGE_JOINTS)); break;
    case 6: start((uint8_t)(fuzz_byte(fuzz) % (FUZZ_PAGES + 2))); break;
    case 7: lay((uint8_t)(1 + fuzz_byte(fuzz) % (FUZZ_PAGES + 2)), 0); break;
    case 8: lay_on_joints(fuzz); break;
    case 9: layers_end(&run.layers); break;
    case 10: move_by_code(fuzz, false); break;
    case 11: move_by_code(fuzz, true); break;
    case 12: layers_free(&run.layers, mask(fuzz)); break;
    case 13: set_shape(fuzz); break;
    case 14: set_speed(fuzz_word(fuzz)); break;
    default: link_end(&run.laid.link); run.alone.link = run.laid.link; break;
    }
    must_be_sane(&run);
    for (unsigned ticks = fuzz_byte(fuzz) & 63; ticks > 0 && ticks_left > 0; ticks--) {
        tick();
    }
}

/* After a break of everything, all motion must stop soon and not restart. */
static void must_stand_after_a_break(void)
{
    uint16_t stands_pos[PAGE_JOINTS];
    ticks_left = BREAK_TICKS + 10;
    break_off();
    while (run.layers.main != NULL && ticks_left > 10) {
        tick();
    }
    ASSERT(run.layers.main == NULL && layers_joints(&run.layers) == 0 && !layers_are_moving(&run.layers));
    memcpy(stands_pos, run.laid.goal_pos, sizeof stands_pos);
    while (ticks_left > 0) {
        tick();
    }
    ASSERT(memcmp(stands_pos, run.laid.goal_pos, sizeof stands_pos) == 0);
}

static void begin(fuzz_t *fuzz)
{
    const uint8_t options = fuzz_byte(fuzz);
    memset(&run, 0, sizeof run);
    run.law = (player_law_t)(options & 1);
    mode = options & 2 ? LINK_HOLD : LINK_LATCH;
    for (unsigned joint = 0; joint < PAGE_JOINTS; joint++) {
        run.laid.goal_pos[joint] = (uint16_t)(joint * 33u);
    }
    layers_init(&run.layers, run.laid.goal_pos);
    set_speed(fuzz_word(fuzz));
    run.present = mask(fuzz) | 3u | bit(17);
    shape_init(&run.shape);
    fuzz_pages_make(fuzz);
    fuzz_pages_set(1, PAGE_AT_BLEND_RIGHT, (uint8_t)(options >> 2 & 7));
    fuzz_pages_set(2, PAGE_AT_BLEND_LEFT, (uint8_t)(options >> 5));
    ticks_left = TICKS_MAX;
    start((uint8_t)(fuzz_byte(fuzz) % (FUZZ_PAGES + 2)));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_t fuzz = {data, data + size};
    begin(&fuzz);
    while (fuzz_left(&fuzz) > 0 && ticks_left > 0) {
        act(&fuzz);
    }
    must_stand_after_a_break();
    return 0;
}
