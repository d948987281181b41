/* SPDX-License-Identifier: MIT
 * Links and player on any pages. Plays end or loop, goals stay within 0..1023 and on permitted joints, and the steps
 * follow step_rules.h.
 *
 * Input: law and first page; joints present; the pages (fuzz_pages.h); then pairs of an action and its argument. */
#include "fuzz_pages.h"
#include "player.h"
#include "step_rules.h"
#include "trap.h"

#include <string.h>

#define TICKS_MAX 3000u

static player_t player;
static player_joint_t states[PAGE_JOINTS];
static link_t links;
static unsigned ticks_left;
static uint32_t present, dropped;
static uint16_t pose[PAGE_JOINTS];
static bool undisturbed;   /* no break or pause since the step began: its targets must be reached */
static step_rules_t rules;

/* After the last tick of a step every joint used by it must be at the page's position. */
static void must_be_on_target(void)
{
    if (!undisturbed || player.law != PLAYER_LAW_EXACT) {
        return;
    }
    ASSERT(player.now.step >= 1);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const uint16_t word = page_pos(fuzz_pages[player.now.page], (uint8_t)(player.now.step - 1), joint);
        ASSERT(((present & ~dropped) >> joint & 1) == 0 || !page_pos_is_used(word) || player_goal(&player, joint) == word);
    }
}

static void must_be_in_range(void)
{
    for (unsigned joint = 0; joint < PAGE_JOINTS; joint++) {
        ASSERT((player.present >> joint & 1) == 0 || player_goal(&player, (uint8_t)joint) <= PAGE_POS_MAX);
    }
    ASSERT(((player.joints | player.present) & (~present | dropped)) == 0 && (player.joints & ~player.present) == 0);
}

static void tick(void)
{
    if (ticks_left == 0) {
        return;
    }
    ticks_left--;
    const bool moving = player_is_moving(&player);
    player_plan(&player, &links);
    step_rules_before(&rules, &player);
    const uint8_t events = player_tick(&player, &links);
    step_rules_behind(&rules, &player, events);
    must_be_in_range();
    ASSERT(moving || events == 0);
    if ((events & PLAYER_EV_STEP) != 0) {
        ASSERT(player.now.page >= 1 && player.now.page <= FUZZ_PAGES);
        ASSERT(player.now.step >= 1 && player.now.step <= fuzz_pages[player.now.page][PAGE_AT_STEPS]);
        ASSERT(page_check(fuzz_pages[player.now.page]) == PAGE_OK);
        undisturbed = true;
    }
    if ((events & PLAYER_EV_ENDED) != 0) {
        ASSERT(!player_is_moving(&player));
        must_be_on_target();
        ASSERT(player.fault == PAGE_OK || player.fault_page != 0);
    }
}

static void start(uint8_t number, player_law_t law)
{
    const bool was_moving = player_is_moving(&player);
    const page_status_t check = number >= 1 && number <= FUZZ_PAGES ? page_check(fuzz_pages[number]) : PAGE_ERR_CHECKSUM;
    link_call(&links, 0);
    const player_status_t status = player_start(&player, &links, number, law, pose, present);
    ASSERT(status != PLAYER_ERR_LAW && (status == PLAYER_ERR_BUSY) == was_moving);
    if (!was_moving) {
        ASSERT(status != PLAYER_OK || check == PAGE_OK);
        ASSERT(check != PAGE_OK || !page_is_playable(fuzz_pages[number]) || status == PLAYER_OK);
        undisturbed = true;
    }
}

static void disturb(void)
{
    undisturbed = false;
    step_rules_disturb(&rules);
}

static void drop(uint32_t joints)
{
    player_drop_joints(&player, joints);
    dropped |= joints;
}

static void act(uint8_t action, uint8_t argument)
{
    switch (action & 7) {
    case 1: link_code(&links, argument); break;
    case 2: link_stop(&links); break;
    case 3: player_break(&player); disturb(); break;
    case 4: player_pause(&player); disturb(); break;
    case 5: player_resume(&player); disturb(); break;
    case 6: drop((uint32_t)1 << argument % PAGE_JOINTS); break;
    case 7: link_end(&links); break;
    default: break;
    }
    for (unsigned i = 0; i < argument + 1u && player_is_moving(&player); i++) {
        tick();
    }
}

/* A break must stop everything within the ramp (at most 255 ticks). */
static void must_stand_after_a_break(void)
{
    ticks_left = 300;
    disturb();
    player_break(&player);
    while (player_is_moving(&player) && ticks_left > 0) {
        tick();
    }
    ASSERT(!player_is_moving(&player));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_t fuzz = {data, data + size};
    const uint8_t options = fuzz_byte(&fuzz), number = fuzz_byte(&fuzz);
    present = (uint32_t)fuzz_word(&fuzz) << 16 | 3u;
    present &= 0x7FFFFFFFu;
    for (unsigned joint = 0; joint < PAGE_JOINTS; joint++) {
        pose[joint] = (uint16_t)(joint * 33u);
    }
    dropped = 0;
    memset(&rules, 0, sizeof rules);
    fuzz_pages_make(&fuzz);
    ticks_left = TICKS_MAX;
    player_init(&player, &fuzz_pages_source, states);
    link_init(&links, options & 2 ? LINK_HOLD : LINK_LATCH);
    (void)player_first_pose(&fuzz_pages_source, NULL, number & 127, (uint16_t[PAGE_JOINTS]){0});
    start(options & 4 ? number : number % (FUZZ_PAGES + 2), (player_law_t)(options & 1));
    while (fuzz_left(&fuzz) > 0 && ticks_left > 0) {
        const uint8_t action = fuzz_byte(&fuzz);
        act(action, fuzz_byte(&fuzz));
    }
    if (player_is_moving(&player)) {
        must_stand_after_a_break();
    }
    return 0;
}
