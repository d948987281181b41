/* SPDX-License-Identifier: MIT
 * A main play that is shaped, a page layer and code-made motion over it, on any pages, with every call of layers.h and
 * shape.h at any tick. Beside it the same play goes without layers: whatever was never lent must go the same way, bit by
 * bit, in the same time. What a robot must not do is in must_move_well, what must fit together in must_be_sane (shaping.md,
 * "Layers").
 *
 * Input: options, hand-over speed, joints present; the pages (fuzz_pages.h), two of which get partners; then what happens:
 * an action, its arguments, and how many ticks go by. */
#include "approach.h"
#include "fuzz_pages.h"
#include "layers.h"
#include "trap.h"

#include <string.h>

#define TICKS_MAX 1200u
#define BREAK_TICKS 300u   /* the longest ramp is 255 */
#define ALL 0x7FFFFFFFu

/* A main play and what is its own. `laid` has layers over it, `alone` has none. */
typedef struct {
    player_t player;
    player_joint_t joint[PAGE_JOINTS];
    uint16_t goal_pos[PAGE_JOINTS];
    link_t link;
    shape_step_t shaping;
} play_t;

static play_t laid, alone;
static layers_t layers;
static shape_t shape;
static player_law_t law;
static link_mode_t mode;
static unsigned ticks_left, hand_over_deg_s, code_deg_s[PAGE_JOINTS];
static uint32_t present, touched;   /* touched: lent since the start, or not as in `alone` for another reason */
static uint32_t whole_step;         /* the main play's since its step began */
static bool undisturbed;            /* no break or pause since then */
static bool keeps_time;             /* `alone` still tells how long things take: see may_differ, pause */

static uint32_t bit(unsigned joint)
{
    return (uint32_t)1 << joint;
}

static int distance(int from, int to)
{
    return from < to ? to - from : from - to;
}

static bool has(uint32_t joints, unsigned joint)
{
    return (joints >> joint & 1u) != 0;
}

/* Servo units a tick of degrees/s, rounded up. */
static int units_a_tick(unsigned deg_s)
{
    return (int)((deg_s * 1024u + 38399u) / 38400u);
}

/* ---- what must hold ---- */

static const layers_code_t *code_of(unsigned joint)
{
    for (unsigned i = 0; i < LAYERS_CODE_JOINTS; i++) {
        if (layers.code[i].joint == joint) {
            return &layers.code[i];
        }
    }
    return NULL;
}

static void must_be_sane(void)
{
    const uint32_t of_page = player_is_moving(&layers.play) ? layers.play.present : 0;
    uint32_t of_code = 0;
    for (unsigned i = 0; i < LAYERS_CODE_JOINTS; i++) {
        const uint8_t joint = layers.code[i].joint;
        ASSERT(joint == LAYERS_NO_JOINT || (joint < PAGE_JOINTS && !has(of_code, joint)));
        of_code |= joint == LAYERS_NO_JOINT ? 0 : bit(joint);
    }
    ASSERT(of_code == layers.code_joints && (of_page & of_code) == 0);
    ASSERT(layers_joints(&layers) == (of_page | of_code));
    if (layers.main == NULL) {
        ASSERT(of_page == 0);
        return;
    }
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const uint8_t owner = has(of_code, joint)   ? PLAYER_OWNER_CODE
                              : has(of_page, joint) ? PLAYER_OWNER_LAYER
                                                    : PLAYER_OWNER_MAIN;
        if (has(laid.player.present, joint)) {
            ASSERT(laid.joint[joint].owner == owner);
            ASSERT(has(laid.player.lent, joint) == (owner == PLAYER_OWNER_CODE));
        }
    }
    /* Pause holds for both, and so does going on. */
    if (player_is_moving(&laid.player) && !laid.player.breaking) {
        const bool paused = player_is_paused(&laid.player);
        ASSERT(layers.paused == paused);
        ASSERT(!player_is_moving(&layers.play) || layers.play.breaking || player_is_paused(&layers.play) == paused);
    }
}

/* How far joint, which code moves, may go in a tick: towards its place at the speed it was given; then 2 pi A / T. */
static int most_of_code(const layers_code_t *code, bool was_there)
{
    if (layers.paused) {
        return 0;
    }
    if (!was_there) {
        return units_a_tick(code_deg_s[code->joint]);
    }
    const int most = (int)((uint64_t)code->amplitude_pos * code->phase_step * 6284u / 1000u >> 32) + 2;
    return code->amplitude_pos == 0 ? 0 : most < (int)LAYERS_SWING_SPEED_MAX + 1 ? most : (int)LAYERS_SWING_SPEED_MAX + 1;
}

/* A joint that changes hands goes no faster than the hand-over speed; in the tick in which it meets its owner's way, as
 * fast as that. */
static int most_of_hand_over(uint8_t joint, int asked_before, bool layer_ended)
{
    const player_t *owner = laid.joint[joint].owner == PLAYER_OWNER_LAYER ? &layers.play : &laid.player;
    const int most = layers.paused ? 0 : units_a_tick(hand_over_deg_s);
    if (laid.joint[joint].hand_over != 0 && !layer_ended) {
        return most;
    }
    const int own_way = distance(player_asks(owner, &laid.joint[joint]), asked_before);
    return most > own_way ? most : own_way;
}

typedef struct {
    uint16_t goal_pos[PAGE_JOINTS], asked_pos[PAGE_JOINTS];
    uint8_t hand_over[PAGE_JOINTS];
    bool there[PAGE_JOINTS];
} before_t;

static void remember(before_t *before)
{
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const layers_code_t *code = code_of(joint);
        const bool of_layer = layers.main != NULL && laid.joint[joint].owner == PLAYER_OWNER_LAYER;
        before->goal_pos[joint] = laid.goal_pos[joint];
        const player_t *owner = of_layer ? &layers.play : &laid.player;
        before->asked_pos[joint] = layers.main != NULL ? player_asks(owner, &laid.joint[joint]) : 0;
        before->hand_over[joint] = layers.main != NULL ? laid.joint[joint].hand_over : 0;
        before->there[joint] = code != NULL && code->there;
    }
}

static void must_move_well(const before_t *before, bool layer_ended)
{
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const layers_code_t *code = code_of(joint);
        const int way = distance(laid.goal_pos[joint], before->goal_pos[joint]);
        ASSERT(laid.goal_pos[joint] <= PAGE_POS_MAX);
        if (code != NULL) {
            ASSERT(way <= most_of_code(code, before->there[joint]));
        } else if (layers.main == NULL || !has(laid.player.present, joint)) {
            ASSERT(way == 0);
        } else if (before->hand_over[joint] != 0) {
            ASSERT(way <= most_of_hand_over(joint, before->asked_pos[joint], layer_ended));
        }
        if (layers.main != NULL && keeps_time && !has(touched, joint)) {
            ASSERT(laid.goal_pos[joint] == alone.goal_pos[joint]);
        }
    }
}

/* Under the classic law a step that begins from a stand is as long as the longest way from where the joints are: a joint
 * that was lent is elsewhere than in `alone`. Only if lengths come from ways: pages of speed base, and the top speed's
 * limit. */
static bool may_differ(void)
{
    bool by_way = shape.top_speed_q4_4 != 0;
    for (unsigned page = 1; page <= FUZZ_PAGES; page++) {
        by_way |= fuzz_pages[page][PAGE_AT_SCHEDULE] != PAGE_SCHEDULE_TIME;
    }
    return law == PLAYER_LAW_CLASSIC && by_way && (touched & present) != 0;
}

/* A joint that was the main play's for a whole step ends it where it would have ended it without layers, but for the
 * unit within which it had caught up, if all that was left of the step was a hold. */
static void must_end_step_well(void)
{
    for (uint8_t joint = 0; joint < PAGE_JOINTS && undisturbed && keeps_time && law == PLAYER_LAW_EXACT; joint++) {
        ASSERT(!has(whole_step & laid.player.present, joint) || distance(laid.goal_pos[joint], alone.goal_pos[joint]) <= 1);
    }
}

/* Joints that are the main play's and go its way. */
static uint32_t at_home(void)
{
    uint32_t joints = 0;
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        const player_joint_t *of_joint = &laid.joint[joint];
        joints |= of_joint->owner == PLAYER_OWNER_MAIN && of_joint->hand_over == 0 ? bit(joint) : 0;
    }
    return joints;
}

static void note_lent(void)
{
    touched |= ~at_home();
    whole_step &= at_home();
}

/* ---- time ---- */

/* The play is over: as the performer does it. */
static void ended(void)
{
    const bool was_broken = laid.player.breaking;
    layers_bind(&layers, NULL);
    if (was_broken) {
        layers_break(&layers);
    }
}

static void tick(void)
{
    before_t before;
    uint8_t of_layer;
    ticks_left--;
    remember(&before);
    const bool bound = layers.main != NULL;
    const uint8_t events = layers_tick(&layers, &laid.link, &of_layer);
    keeps_time = keeps_time && !may_differ();
    const uint8_t events_alone = bound && keeps_time ? player_tick(&alone.player, &alone.link) : events;
    ASSERT(events == events_alone && (bound || events == 0));
    must_move_well(&before, (of_layer & PLAYER_EV_ENDED) != 0);
    if (bound && keeps_time) {
        ASSERT(laid.player.page == alone.player.page && laid.player.step == alone.player.step);
    }
    if (bound) {
        note_lent();
    }
    if ((events & (PLAYER_EV_STEP | PLAYER_EV_ENDED)) != 0) {
        must_end_step_well();
        whole_step = at_home();
        undisturbed = true;
    }
    if ((events & PLAYER_EV_ENDED) != 0) {
        ended();
    }
    must_be_sane();
}

/* ---- the main play ---- */

static void call(void)
{
    link_init(&laid.link, mode);
    link_call(&laid.link, 0);
    alone.link = laid.link;
}

static player_status_t start_one(play_t *play, uint8_t number)
{
    player_init(&play->player, &fuzz_pages_source, play->joint, play->goal_pos);
    player_set_shape(&play->player, &shape, &play->shaping);
    if (play == &laid) {
        layers_bind(&layers, &laid.player);
    }
    return player_start(&play->player, &play->link, number, law, laid.goal_pos, present);
}

static void start(uint8_t number)
{
    if (layers.main != NULL) {
        return;
    }
    call();
    memset(laid.joint, 0, sizeof laid.joint);   /* the approach had this memory */
    const player_status_t status = start_one(&alone, number);
    ASSERT(start_one(&laid, number) == status);
    if (status != PLAYER_OK) {
        layers_bind(&layers, NULL);
        return;
    }
    touched = 0;
    keeps_time = true;
    note_lent();
    whole_step = at_home();
    undisturbed = true;
}

static void drop(uint32_t joints)
{
    layers_drop_joints(&layers, joints);
    if (layers.main != NULL) {
        player_drop_joints(&laid.player, joints);
        player_drop_joints(&alone.player, joints);
    }
    whole_step &= ~joints;
}

static void pause(void)
{
    if (layers.main == NULL || player_is_paused(&laid.player) || laid.player.breaking) {
        return;
    }
    undisturbed = false;
    /* The rest of a step whose time is over takes a ramp if one of the play's own joints is off its target. */
    keeps_time = keeps_time && (touched & present) == 0;
    layers_pause(&layers);
    player_pause(&laid.player);
    player_pause(&alone.player);
}

static void resume(void)
{
    if (layers.main == NULL || !player_is_paused(&laid.player)) {
        return;
    }
    layers_resume(&layers);
    player_resume(&laid.player);
    player_resume(&alone.player);
}

static void break_off(void)
{
    undisturbed = false;
    layers_break(&layers);
    if (layers.main != NULL) {
        player_break(&laid.player);
        player_break(&alone.player);
    }
}

/* ---- layers ---- */

static void lay(uint8_t page, uint32_t joints)
{
    const layers_t old = layers;
    const play_t old_laid = laid;
    const bool of_first_step = joints == 0;
    const layers_status_t status = layers_start(&layers, page, joints);
    if (status == LAYERS_OK) {
        ASSERT(layers.main != NULL && page >= 1 && page <= FUZZ_PAGES && page_check(fuzz_pages[page]) == PAGE_OK);
        ASSERT((layers.play.present & ~laid.player.present) == 0 && layers.play.present != 0);
        ASSERT(of_first_step || (layers.play.present & ~joints) == 0);
        return;
    }
    layers.play.fault = old.play.fault;
    layers.play.fault_page = old.play.fault_page;
    ASSERT(memcmp(&layers, &old, sizeof layers) == 0 && memcmp(&laid, &old_laid, sizeof laid) == 0);
}

/* Code moves a joint: aim (amplitude 0, with its own speed), or swing. */
static void move_by_code(fuzz_t *fuzz, bool swings)
{
    uint8_t id = fuzz_byte(fuzz);
    /* Without a play the caller asks who is there. */
    id = layers.main != NULL || id >= PAGE_JOINTS || has(present, id) ? id : 0;
    const uint16_t pos = fuzz_word(fuzz) & 0x7FF;
    const uint16_t amount = fuzz_byte(fuzz), period = swings ? fuzz_word(fuzz) : 0;
    const layers_t old = layers;
    const play_t old_laid = laid;
    const layers_status_t status = swings ? layers_swing(&layers, id, pos, amount, period, (uint16_t)(period * 7u & 0x1FF))
                                          : layers_aim(&layers, id, pos, (uint16_t)(amount * 2u));
    if (status == LAYERS_OK) {
        ASSERT(id < PAGE_JOINTS && has(layers.code_joints, id));
        code_deg_s[id] = swings || amount == 0 ? hand_over_deg_s : (unsigned)amount << 1;
        return;
    }
    ASSERT(memcmp(&layers, &old, sizeof layers) == 0 && memcmp(&laid, &old_laid, sizeof laid) == 0);
}

static void set_speed(uint16_t deg_s)
{
    deg_s = deg_s % (LAYERS_SPEED_MAX_DEG_S + 1u);
    layers_set_speed(&layers, deg_s);
    hand_over_deg_s = deg_s != 0 ? deg_s : APPROACH_SPEED_DEFAULT;
}

/* ---- shape ---- */

static void set_shape(fuzz_t *fuzz)
{
    const uint8_t what = fuzz_byte(fuzz);
    const uint16_t value = fuzz_word(fuzz) & 0x1FF;
    const shape_t old = shape;
    shape_status_t status = SHAPE_OK;
    switch (what & 7) {
    case 0: status = shape_set_rate(&shape, value); break;
    case 1: status = shape_set_amplitude(&shape, value, ALL); break;
    case 2: status = shape_set_amplitude(&shape, value, bit(what >> 3)); break;
    case 3: status = shape_set_blend(&shape, (int16_t)((int)value - 128)); break;
    case 4: status = shape_set_centre(&shape, (uint8_t)value); break;
    case 5: shape_set_voltage(&shape, (uint8_t)value); break;
    case 6: shape_reset(&shape); break;
    default: break;
    }
    ASSERT(status == SHAPE_OK || memcmp(&shape, &old, sizeof shape) == 0);
    ASSERT(shape.rate_percent >= SHAPE_RATE_MIN && shape.rate_percent <= SHAPE_RATE_MAX);
}

/* ---- an input ---- */

static uint32_t mask(fuzz_t *fuzz)
{
    const uint16_t word = fuzz_word(fuzz);   /* joints 0, 1, 17, 30 are those that the pages move */
    return ((uint32_t)(word & 0x4003) << 16 | word) & ALL;
}

static void to_link(uint8_t code)
{
    if (code == 0xFF) {
        link_stop(&laid.link);
    } else {
        link_code(&laid.link, code);
    }
    alone.link = laid.link;
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
    case 7: lay((uint8_t)(fuzz_byte(fuzz) % (FUZZ_PAGES + 3)), 0); break;
    case 8: lay((uint8_t)(1 + fuzz_byte(fuzz) % FUZZ_PAGES), mask(fuzz)); break;
    case 9: layers_end(&layers); break;
    case 10: move_by_code(fuzz, false); break;
    case 11: move_by_code(fuzz, true); break;
    case 12: layers_free(&layers, mask(fuzz)); break;
    case 13: set_shape(fuzz); break;
    case 14: set_speed(fuzz_word(fuzz)); break;
    default: link_end(&laid.link); alone.link = laid.link; break;
    }
    if (layers.main != NULL) {
        note_lent();
    }
    must_be_sane();
    for (unsigned ticks = fuzz_byte(fuzz) & 63; ticks > 0 && ticks_left > 0; ticks--) {
        tick();
    }
}

/* A break of everything: all that is being moved stands soon, and stays. */
static void must_stand_after_a_break(void)
{
    uint16_t stands_pos[PAGE_JOINTS];
    ticks_left = BREAK_TICKS + 10;
    break_off();
    while (layers.main != NULL && ticks_left > 10) {
        tick();
    }
    ASSERT(layers.main == NULL && layers_joints(&layers) == 0 && !layers_are_moving(&layers));
    memcpy(stands_pos, laid.goal_pos, sizeof stands_pos);
    while (ticks_left > 0) {
        tick();
    }
    ASSERT(memcmp(stands_pos, laid.goal_pos, sizeof stands_pos) == 0);
}

static void begin(fuzz_t *fuzz)
{
    const uint8_t options = fuzz_byte(fuzz);
    law = (player_law_t)(options & 1);
    mode = options & 2 ? LINK_HOLD : LINK_LATCH;
    memset(&laid, 0, sizeof laid);
    memset(&alone, 0, sizeof alone);
    for (unsigned joint = 0; joint < PAGE_JOINTS; joint++) {
        laid.goal_pos[joint] = (uint16_t)(joint * 33u);
    }
    layers_init(&layers, laid.goal_pos);
    set_speed(fuzz_word(fuzz));
    present = mask(fuzz) | 3u | bit(17);
    touched = whole_step = 0;
    shape_init(&shape);
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
