/* SPDX-License-Identifier: MIT */
#include "performer.h"

#include <string.h>
#include "bound.h"
#include "performer_parts.h"

void performer_init(performer_t *performer, const page_source_t *source, servo_link_t *servos,
                    const settings_t *settings)
{
    memset(performer, 0, sizeof *performer);
    performer->servos = servos;
    performer->settings = settings;
    performer_set_source(performer, source);
}

void performer_set_source(performer_t *performer, const page_source_t *source)
{
    performer->source = source;
    player_init(&performer->engine.player, source, performer->engine.joint, performer->pose_pos);
}

/* ---- what it is doing ---- */

bool performer_is_idle(const performer_t *performer)
{
    return performer->state == PERFORMER_IDLE;
}

bool performer_is_paused(const performer_t *performer)
{
    return performer->state == PERFORMER_STOOD ||
           (performer->state == PERFORMER_PLAY && player_is_paused(&performer->engine.player));
}

uint32_t performer_usable(const performer_t *performer)
{
    return PERFORMER_SERVOS(performer)->present & ~performer->released;
}

bool performer_next_event(performer_t *performer, performer_event_t *event)
{
    return performer_event_take(&performer->events, event);
}

/* The end of the player: behind the approach, and behind the goals that servo_link may still be sending. */
uint8_t *performer_spare(performer_t *performer)
{
    STATIC_ASSERT(sizeof performer->engine.player + PAGE_BYTES <= sizeof performer->engine &&
                  sizeof performer->engine.approach + PAGE_BYTES <= sizeof performer->engine,
                  "the spare bytes are the joints' of the player");
    return performer_is_idle(performer) ? (uint8_t *)(&performer->engine + 1) - PAGE_BYTES : NULL;
}

/* ---- start ---- */

static performer_status_t somebody_can_move(const performer_t *performer)
{
    if (!performer_is_idle(performer)) {
        return PERFORMER_ERR_BUSY;
    }
    if (PERFORMER_SERVOS(performer)->present == 0) {
        return PERFORMER_ERR_NO_SERVOS;
    }
    return performer_usable(performer) == 0 ? PERFORMER_ERR_RELEASED : PERFORMER_OK;
}

/* Binds the player anew and starts it at `page` from pose_pos. */
static player_status_t start_player(performer_t *performer, uint8_t page, uint32_t joints)
{
    player_t *player = &performer->engine.player;
    const player_law_t law =
        PERFORMER_SETTINGS(performer)->law == PLAYER_LAW_CLASSIC ? PLAYER_LAW_CLASSIC : PLAYER_LAW_EXACT;
    player_init(player, performer->source, performer->engine.joint, performer->pose_pos);
    return player_start(player, &performer->link, page, law, performer->pose_pos, joints);
}

static performer_status_t refusal(performer_t *performer, player_status_t status)
{
    performer->fault = performer->engine.player.fault;
    performer->fault_page = performer->engine.player.fault_page;
    switch (status) {
    case PLAYER_OK:
        return PERFORMER_OK;
    case PLAYER_ERR_RANGE:
        return PERFORMER_ERR_RANGE;
    case PLAYER_ERR_PAGE:
        return PERFORMER_ERR_PAGE;
    case PLAYER_ERR_EMPTY:
        return PERFORMER_ERR_EMPTY;
    case PLAYER_ERR_LAW:
        return PERFORMER_ERR_LAW;
    default:
        return PERFORMER_ERR_BUSY;
    }
}

static void call_link(performer_t *performer, uint8_t code)
{
    link_init(&performer->link, PERFORMER_SETTINGS(performer)->remote_mode == LINK_HOLD ? LINK_HOLD : LINK_LATCH);
    link_call(&performer->link, code);
}

performer_status_t performer_start(performer_t *performer, uint8_t page, uint8_t code)
{
    performer_status_t status = somebody_can_move(performer);
    if (status != PERFORMER_OK) {
        return status;
    }
    /* A start without joints, only to hear what the player has against this page. It may use the links up: call again. */
    call_link(performer, code);
    status = refusal(performer, start_player(performer, page, 0));
    if (status != PERFORMER_OK) {
        player_init(&performer->engine.player, performer->source, performer->engine.joint, performer->pose_pos);
        return status;
    }
    call_link(performer, code);
    performer->page = page;
    performer->first_page = performer->engine.player.page;
    performer->move_deg_s = 0;
    performer->since_stop_ticks = UINT8_MAX;
    performer_get_ready(performer);
    return PERFORMER_OK;
}

performer_status_t performer_move(performer_t *performer, const uint16_t to_pos[PAGE_JOINTS], uint32_t joints,
                                  uint16_t deg_s)
{
    const performer_status_t status = somebody_can_move(performer);
    if (status != PERFORMER_OK) {
        return status;
    }
    memcpy(performer->engine.approach.target_pos, to_pos, sizeof performer->engine.approach.target_pos);
    performer->page = 0;
    performer->move_deg_s = deg_s;
    performer->move_joints = joints;
    performer->since_stop_ticks = UINT8_MAX;
    performer_get_ready(performer);
    return PERFORMER_OK;
}

/* ---- from one state to the next ---- */

/* Every joint stands where the page or the move begins. */
static void begin(performer_t *performer)
{
    if (performer->move_deg_s != 0) {
        performer_go_idle(performer, PERFORMER_END_THERE);
        return;
    }
    performer->state = PERFORMER_PLAY;
    performer->slopes_due = false;
    if (start_player(performer, performer->page, performer->joints) != PLAYER_OK) {
        performer_go_idle(performer, PERFORMER_END_PAGE);
    }
}

static void poll_ready(performer_t *performer)
{
    if (performer->leaving) {
        performer_go_idle(performer, performer->end_reason);
        return;
    }
    switch (performer_ready_poll(performer)) {
    case READY_SILENT:
        performer_go_idle(performer, PERFORMER_END_SERVO);
        break;
    case READY_APPROACH:
        performer->state = PERFORMER_APPROACH;
        break;
    case READY_THERE:
        begin(performer);
        break;
    default:
        break;
    }
}

static void approach_over(performer_t *performer)
{
    if (performer->leaving) {
        performer_go_idle(performer, performer->end_reason);
    } else if (performer->pausing) {
        performer->state = PERFORMER_STOOD;
        performer_event_put(&performer->events, PERFORMER_EV_PAUSED, performer->page, 0, 0);
    } else {
        begin(performer);
    }
}

static uint8_t why_ended(const performer_t *performer)
{
    const player_t *player = &performer->engine.player;
    if (player->fault != PAGE_OK) {
        return PERFORMER_END_PAGE;
    }
    if (performer->leaving || performer->end_reason != PERFORMER_END_DONE) {
        return performer->end_reason;
    }
    if (player->link_taken == LINK_END_OF_EXIT_LOOP) {
        return PERFORMER_END_LOOP;
    }
    return link_is_stopping(&performer->link) ? PERFORMER_END_STOPPED : PERFORMER_END_DONE;
}

/* ---- the loop ---- */

static void act_on(performer_t *performer, performer_verdict_t verdict, uint32_t joint)
{
    performer_drop(performer, joint);
    if (verdict == WATCH_LIMP) {
        servo_link_torque_off(PERFORMER_SERVOS(performer), joint);
        return;
    }
    performer->end_reason = PERFORMER_END_SERVO;
    if (verdict == WATCH_EXIT) {
        performer_stop_softly(performer);
    } else {
        performer_break(performer);
    }
}

void performer_poll(performer_t *performer)
{
    uint32_t failed;
    performer_verdict_t verdict;
    servo_link_poll(PERFORMER_SERVOS(performer));
    while ((verdict = performer_watch(performer, &failed)) != WATCH_GO_ON) {
        act_on(performer, verdict, failed);
    }
    if (performer->state == PERFORMER_READY) {
        poll_ready(performer);
    }
}

/* ---- the tick ---- */

/* The compliance bytes of the page that has just begun, to the servos. Not inlined: the tick would keep 31 bytes of stack
 * for what happens once a page. */
static NOINLINE void send_slopes(performer_t *performer)
{
    uint8_t compliance[PAGE_JOINTS];
    performer->source->read(performer->source->context, performer->engine.player.page, PAGE_AT_COMPLIANCE, compliance,
                            sizeof compliance);
    servo_link_slopes(PERFORMER_SERVOS(performer), compliance);
}

static void approach_or_move_tick(performer_t *performer)
{
    const bool under_way = approach_tick(&performer->engine.approach, performer->pose_pos);
    const uint32_t joints = performer->engine.approach.joints & performer->joints;
    servo_link_goals(PERFORMER_SERVOS(performer), performer->pose_pos, joints);
    if (!under_way) {
        approach_over(performer);
    }
}

/* Tells what the player did in this tick. */
static void tell(performer_t *performer, uint8_t events)
{
    const player_t *player = &performer->engine.player;
    if ((events & PLAYER_EV_STEP) != 0) {
        performer->page = player->page;
        performer_event_put(&performer->events, PERFORMER_EV_STEP, player->page, player->step, player->repetition);
    }
    if ((events & PLAYER_EV_LINK) != 0) {
        performer_event_put(&performer->events, PERFORMER_EV_LINK, player->next_page, player->link_taken, 0);
    }
    if ((events & PLAYER_EV_ENDED) != 0 || ((events & PLAYER_EV_STANDING) != 0 && performer->leaving)) {
        performer_go_idle(performer, why_ended(performer));
    } else if ((events & PLAYER_EV_STANDING) != 0) {
        performer_event_put(&performer->events, PERFORMER_EV_PAUSED, player->page, 0, 0);
    }
}

/* A page's slopes go out a tick or more after its first goals: the tick in which a page begins has enough to do. */
static void play_tick(performer_t *performer)
{
    player_t *player = &performer->engine.player;
    const uint8_t events = player_tick(player, &performer->link);
    if ((events & PLAYER_EV_PAGE) != 0) {
        performer->slopes_due = true;
    } else if (performer->slopes_due) {
        performer->slopes_due = false;
        send_slopes(performer);
        servo_link_defer_rest(PERFORMER_SERVOS(performer));
    }
    if ((events & PLAYER_EV_OUTPUT) != 0) {
        servo_link_goals(PERFORMER_SERVOS(performer), player->goal_pos, player->joints);
    }
    tell(performer, events);
}

void performer_tick(performer_t *performer)
{
    servo_link_tick(PERFORMER_SERVOS(performer));
    if (performer->since_stop_ticks < UINT8_MAX) {
        performer->since_stop_ticks++;
    }
    if (performer->state == PERFORMER_APPROACH) {
        approach_or_move_tick(performer);
    } else if (performer->state == PERFORMER_PLAY) {
        play_tick(performer);
    }
}
