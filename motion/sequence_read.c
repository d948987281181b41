/* SPDX-License-Identifier: MIT
 * sequence_read.c - reads a step's position words, shapes them and measures their ways. */
#include "sequence_parts.h"
#include "shape_step.h"

/* --- a step ------------------------------------------------------------------------------------------------------- */

/* The position words of a step, PAGE_POS_UNUSED for all that are not used or not in `joints`. Returns the joints' bits that
 * are used. */
static uint32_t read_words(const page_source_t *source, uint8_t page, uint8_t step, uint32_t joints,
                           uint16_t words[PAGE_JOINTS])
{
    /* A joint's bit leaves `joints` as the lowest one; the bit of what it uses enters as the highest. */
    source->read(source->context, page, (uint16_t)(PAGE_STEP_BYTES * step), words, 2u * PAGE_JOINTS);
    uint16_t *word = words;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--, word++) {
        bool is_used = ((uint8_t)joints & 1u) != 0 && page_pos_is_used(*word);
        joints >>= 1;
        if (is_used) {
            joints |= 0x80000000u;
        } else {
            *word = PAGE_POS_UNUSED;
        }
    }
    return joints >> 1; /* 31 joints */
}

uint32_t player_first_pose(const page_source_t *source, const shape_t *shape, uint8_t page, uint16_t pose_pos[PAGE_JOINTS])
{
    uint16_t words[PAGE_JOINTS];
    uint32_t joints = read_words(source, page, 1, UINT32_MAX, words);
    shape_step_t shaping;
    if (shape != NULL && shape_step_begin(&shaping, shape, source, page, 1)) {
        for (uint8_t left = SHAPE_STEP_SHARES; left != 0; left--) {
            shape_step_share(&shaping, source, words);
        }
    }
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        if (words[i] != PAGE_POS_UNUSED) {
            pose_pos[i] = words[i];
        }
    }
    return joints;
}

/* --- the step that is looked at ----------------------------------------------------------------------------------- */

bool sequence_looks_elsewhere(const player_t *player)
{
    return LAW_IS_CLASSIC(player) && player->look_page != player->coming.page;
}

bool sequence_shapes(const shape_t *shape)
{
    return shape != NULL && !shape_is_neutral(shape);
}

/* Reads a step's words to looked_at. Page 0: no joint is used. */
static NOINLINE void look_at(player_t *player, uint8_t page, uint8_t step)
{
    player->looked_joints = read_words(player->source, page, step, page != 0 ? player->present : 0, player->looked_at);
}

void sequence_shape_a_share(player_t *player)
{
    if (player->shares_left-- > SHAPE_STEP_SHARES) {
        look_at(player, player->coming.page, player->coming.step);
    } else {
        shape_step_share(player->shaping, player->source, player->looked_at);
    }
}

STATIC_ASSERT(offsetof(player_step_t, time) == offsetof(player_step_t, pause) + 1, "side by side, as in a step");

/* Reads the coming step, and begins to shape it. */
static void look_at_coming(player_t *player)
{
    player_step_t *coming = &player->coming;
    const shape_t *shape = player->shape;
    bool shaped = sequence_shapes(shape);
    player->source->read(player->source->context, coming->page,
                         (uint16_t)(PAGE_STEP_BYTES * coming->step + PAGE_STEP_AT_PAUSE), &coming->pause, 2);
    coming->rate_percent = shaped ? shape->rate_percent : SHAPE_NORMAL;
    coming->top_speed_q4_4 = shaped ? shape->top_speed_q4_4 : 0;
    player->shares_left = 0;
    if (shaped && shape_step_begin(player->shaping, shape, player->source, coming->page, coming->step)) {
        player->shares_left = SHAPE_STEP_SHARES + 1u;
    } else {
        look_at(player, coming->page, coming->step);
    }
}

void sequence_read(player_t *player)
{
    if (sequence_shapes(player->shape)) {
        player->look_page = player->coming.page; /* the original has no shaped step to be equal to */
    }
    if (sequence_looks_elsewhere(player)) {
        look_at(player, player->look_page, 1);
    } else if (player->coming.page != 0) {
        look_at_coming(player);
    } else {
        look_at(player, 0, 0);
    }
}

void sequence_look_first(player_t *player)
{
    player->look_page = player->coming.page;
    look_at_coming(player);
}

/* --- measure and take --------------------------------------------------------------------------------------------- */

/* Shapes the remaining joints of the step that was looked at. */
static void shape_the_rest(player_t *player)
{
    while (player->shares_left != 0) {
        sequence_shape_a_share(player);
    }
}

void sequence_measure(player_t *player)
{
    uint16_t longest = 0, longest_lent = 0;
    if (sequence_looks_elsewhere(player)) { /* the step that will really be played */
        player->coming.page != 0 ? look_at_coming(player) : look_at(player, 0, 0);
    }
    shape_the_rest(player);
    player->coming_way = player->lent_way = 0;
    if (player->coming.schedule != PAGE_SCHEDULE_SPEED && player->coming.top_speed_q4_4 == 0) {
        return;
    }
    const uint16_t *looked_at = player->looked_at, *from = player->coming_pos;
    const uint8_t self = player->self;
    const player_joint_t *joint = player->joint;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--, joint++) {
        uint16_t from_pos = *from++, to_pos = *looked_at++;
        if (to_pos == PAGE_POS_UNUSED) {
            continue;
        }
        uint16_t way = to_pos > from_pos ? (uint16_t)(to_pos - from_pos) : (uint16_t)(from_pos - to_pos);
        longest = way > longest ? way : longest;
        if (!law_owns(self, joint) && way > longest_lent) {
            longest_lent = way;
        }
    }
    player->coming_way = longest;
    player->lent_way = longest_lent;
}

uint8_t sequence_take(player_t *player)
{
    uint8_t own = 0;
    const uint8_t self = player->self;
    uint16_t *pos = player->coming_pos;
    const uint16_t *looked_at = player->looked_at;
    player_joint_t *joint = player->joint;
    for (uint8_t left = PAGE_JOINTS; left != 0; left--, joint++, pos++) {
        uint16_t word = *looked_at++;
        if (law_owns(self, joint)) {
            joint->target_pos = *pos;
            own++;
        }
        if (word != PAGE_POS_UNUSED) {
            *pos = word;
        }
    }
    player->coming_joints = player->looked_joints;
    player->looked = player->measured = false;
    return own;
}
