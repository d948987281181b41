/* SPDX-License-Identifier: MIT */
#include "performer.h"

#include <string.h>
#include "bound.h"
#include "performer_parts.h"

#define SECOND_STOP_TICKS PLAYER_TICKS_PER_SECOND

/* ---- beginning and end ---- */

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
    player_init(&performer->engine.player, source);
}

bool performer_is_idle(const performer_t *performer)
{
    return performer->state == PERFORMER_IDLE;
}

/* The end of the player: behind the approach, and behind the goals that servo_link may still be sending. */
uint8_t *performer_spare(performer_t *performer)
{
    STATIC_ASSERT(sizeof performer->engine.player - sizeof performer->engine.player.joint + PAGE_BYTES
                  <= sizeof performer->engine && sizeof performer->engine.approach + PAGE_BYTES <= sizeof performer->engine,
                  "the spare bytes are the joints' of the player");
    return performer_is_idle(performer) ? (uint8_t *)(&performer->engine + 1) - PAGE_BYTES : NULL;
}

bool performer_is_paused(const performer_t *performer)
{
    return performer->state == PERFORMER_STOOD ||
           (performer->state == PERFORMER_PLAY && player_is_paused(&performer->engine.player));
}

void performer_finish(performer_t *performer, uint8_t end)
{
    uint8_t page_fault = PAGE_OK;
    if (performer->state == PERFORMER_PLAY) {
        const player_t *player = &performer->engine.player;
        performer->page = player->fault != PAGE_OK ? player->fault_page : player->page;
        page_fault = player->fault;
    }
    performer->state = PERFORMER_IDLE;
    performer_tell(performer, PERFORMER_EV_ENDED, performer->page, page_fault, end);
}

/* Joints that answer the bus and were not switched off by hand. */
static uint32_t usable(const performer_t *performer)
{
    return PERFORMER_SERVOS(performer)->present & ~performer->released;
}

static performer_status_t somebody_can_move(const performer_t *performer)
{
    if (!performer_is_idle(performer)) {
        return PERFORMER_ERR_BUSY;
    }
    if (PERFORMER_SERVOS(performer)->present == 0) {
        return PERFORMER_ERR_NO_SERVOS;
    }
    return usable(performer) == 0 ? PERFORMER_ERR_RELEASED : PERFORMER_OK;
}

static void get_ready(performer_t *performer)
{
    performer->ready_left = usable(performer);
    performer->joints = 0;
    performer->faulty = 0;
    performer->leaving = false;
    performer->pausing = false;
    performer->told_battery = false;
    performer->told_hot = false;
    performer->end = PERFORMER_END_DONE;
    performer->state = PERFORMER_READY;
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
    status = refusal(performer, performer_start_player(performer, page, 0));
    if (status != PERFORMER_OK) {
        player_init(&performer->engine.player, performer->source);
        return status;
    }
    call_link(performer, code);
    performer->page = page;
    performer->first_page = performer->engine.player.page;
    performer->move_deg_s = 0;
    performer->since_stop_ticks = UINT8_MAX;
    get_ready(performer);
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
    get_ready(performer);
    return PERFORMER_OK;
}

/* ---- the loop and the tick ---- */

void performer_poll(performer_t *performer)
{
    servo_link_poll(PERFORMER_SERVOS(performer));
    performer_watch(performer);
    if (performer->state == PERFORMER_READY) {
        performer_ready_poll(performer);
    }
}

static void approach_over(performer_t *performer)
{
    if (performer->leaving) {
        performer_finish(performer, performer->end);
    } else if (performer->pausing) {
        performer->state = PERFORMER_STOOD;
        performer_tell(performer, PERFORMER_EV_PAUSED, performer->page, 0, 0);
    } else if (performer->move_deg_s != 0) {
        performer_finish(performer, PERFORMER_END_THERE);
    } else {
        performer_begin_page(performer);
    }
}

/* The compliance bytes of the page that has just begun, to the servos: a tick or more after its first goals, because the
 * tick in which a page begins has enough to do. */
static NOINLINE void send_slopes(performer_t *performer)
{
    uint8_t compliance[PAGE_JOINTS];
    performer->source->read(performer->source->context, performer->engine.player.page, PAGE_AT_COMPLIANCE, compliance,
                            sizeof compliance);
    servo_link_slopes(PERFORMER_SERVOS(performer), compliance);
}

static uint8_t why_ended(const performer_t *performer)
{
    const player_t *player = &performer->engine.player;
    if (player->fault != PAGE_OK) {
        return PERFORMER_END_PAGE;
    }
    if (performer->leaving || performer->end != PERFORMER_END_DONE) {
        return performer->end;
    }
    if (player->link_taken == LINK_END_OF_EXIT_LOOP) {
        return PERFORMER_END_LOOP;
    }
    return link_is_stopping(&performer->link) ? PERFORMER_END_STOPPED : PERFORMER_END_DONE;
}

static NOINLINE void approach_or_move_tick(performer_t *performer)
{
    const bool under_way = approach_tick(&performer->engine.approach, performer->pose_pos);
    const uint32_t joints = performer->engine.approach.joints & performer->joints;
    servo_link_goals(PERFORMER_SERVOS(performer), performer->pose_pos, joints);
    if (!under_way) {
        approach_over(performer);
    }
}

static void play_tick(performer_t *performer)
{
    player_t *player = &performer->engine.player;
    uint8_t events = player_tick(player, &performer->link);
    if ((events & PLAYER_EV_PAGE) != 0) {
        performer->slopes_due = true;
    } else if (performer->slopes_due && (events & PLAYER_EV_BUSY) == 0) {
        performer->slopes_due = false;
        send_slopes(performer);
        events |= PLAYER_EV_BUSY;
    }
    if ((events & PLAYER_EV_OUTPUT) != 0) {
        servo_link_goals(PERFORMER_SERVOS(performer), player->goal_pos, player->joints);
    }
    if ((events & PLAYER_EV_BUSY) != 0) {
        servo_link_hold_rest(PERFORMER_SERVOS(performer));
    }
    if ((events & PLAYER_EV_STEP) != 0) {
        performer->page = player->page;
        performer_tell(performer, PERFORMER_EV_STEP, player->page, player->step, player->repetition);
    }
    if ((events & PLAYER_EV_LINK) != 0) {
        performer_tell(performer, PERFORMER_EV_LINK, player->next_page, player->link_taken, 0);
    }
    if ((events & PLAYER_EV_ENDED) != 0 || ((events & PLAYER_EV_STANDING) != 0 && performer->leaving)) {
        performer_finish(performer, why_ended(performer));
    } else if ((events & PLAYER_EV_STANDING) != 0) {
        performer_tell(performer, PERFORMER_EV_PAUSED, player->page, 0, 0);
    }
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

/* ---- stop, break, pause ---- */

static void resume_if_paused(performer_t *performer)
{
    if (player_is_paused(&performer->engine.player)) {
        player_resume(&performer->engine.player);
    }
}

void performer_stop_softly(performer_t *performer)
{
    link_stop(&performer->link);
    resume_if_paused(performer);
}

void performer_break(performer_t *performer)
{
    if (performer_is_idle(performer) || performer->leaving) {
        return;
    }
    performer->leaving = true;
    if (performer->end == PERFORMER_END_DONE) {
        performer->end = PERFORMER_END_BROKEN;
    }
    if (performer->state == PERFORMER_APPROACH) {
        approach_break(&performer->engine.approach);
    } else if (performer->state == PERFORMER_STOOD) {
        performer_finish(performer, performer->end);
    } else if (performer->state == PERFORMER_PLAY) {
        player_break(&performer->engine.player);
    }
}

/* One more stop: true when it is the second within a second, or comes before the first step, and so was made a break. */
static bool stop_is_break(performer_t *performer)
{
    const bool again = performer->since_stop_ticks < SECOND_STOP_TICKS;
    performer->since_stop_ticks = 0;
    if (performer->state == PERFORMER_PLAY && !again) {
        return false;
    }
    performer_break(performer);
    return true;
}

void performer_stop(performer_t *performer)
{
    if (!stop_is_break(performer)) {
        performer_stop_softly(performer);
    }
}

void performer_end(performer_t *performer)
{
    if (performer->state != PERFORMER_PLAY) {
        performer_break(performer);
        return;
    }
    link_end(&performer->link);
    resume_if_paused(performer);
}

bool performer_pause(performer_t *performer)
{
    if (performer->leaving || performer->move_deg_s != 0 || performer_is_paused(performer)) {
        return false;
    }
    if (performer->state == PERFORMER_PLAY) {
        player_pause(&performer->engine.player);
        return true;
    }
    if (performer->state == PERFORMER_APPROACH && !performer->pausing) {
        performer->pausing = true;
        approach_break(&performer->engine.approach);
        return true;
    }
    return false;
}

bool performer_resume(performer_t *performer)
{
    if (performer->leaving || !performer_is_paused(performer)) {
        return false;
    }
    if (performer->state == PERFORMER_PLAY) {
        player_resume(&performer->engine.player);
    } else {
        get_ready(performer);
    }
    return true;
}

void performer_code(performer_t *performer, uint8_t code)
{
    if (performer_is_idle(performer)) {
        return;
    }
    if (code == LINK_CODE_STOP && stop_is_break(performer)) {
        return;
    }
    link_code(&performer->link, code);
    if (code == LINK_CODE_STOP) {
        resume_if_paused(performer);
    }
    /* A hand that lets go before the first step: there is no page yet to leave softly. */
    if (performer->state != PERFORMER_PLAY && link_is_stopping(&performer->link)) {
        performer_break(performer);
    }
}

/* ---- torque ---- */

void performer_drop(performer_t *performer, uint32_t joints)
{
    performer->joints &= ~joints;
    performer->ready_left &= ~joints;
    if (performer->state == PERFORMER_PLAY) {
        player_drop_joints(&performer->engine.player, joints);
    }
}

uint32_t performer_on(performer_t *performer, uint32_t joints)
{
    if (!performer_is_idle(performer)) {
        return 0;
    }
    joints &= PERFORMER_SERVOS(performer)->present;
    const uint32_t on = servo_link_torque_on(PERFORMER_SERVOS(performer), joints);
    performer->released &= ~on;
    performer->faulty &= ~on;
    return on;
}

void performer_off(performer_t *performer, uint32_t joints)
{
    performer->released |= joints;
    performer_drop(performer, joints);
    servo_link_torque_off(PERFORMER_SERVOS(performer), joints & PERFORMER_SERVOS(performer)->present);
    if (!performer_is_idle(performer) && (performer->joints | performer->ready_left) == 0) {
        performer_finish(performer, PERFORMER_END_BROKEN); /* nobody is left who moves */
    }
}
