/* SPDX-License-Identifier: MIT
 * performer.c - plays and moves: start, approach, tick, stop, pause, end. performer_watch.c handles servo faults;
 * performer_shape.h has layers and driving by a program. */
#include "performer.h"

#include <string.h>
#include "bus.h"
#include "performer_shape.h"
#include "performer_watch.h"
#include "system.h"
#include "tick.h"

#define LATE_TICKS 13u   /* 0.1 s */
#define SECOND_STOP_TICKS PLAYER_TICKS_PER_SECOND

/* An idle player with the performer's shape. */
static void fresh_player(performer_t *performer)
{
    player_t *player = &performer->player;
    player_init(player, performer->source, performer->joint);
    player->shape = &performer->shape;
}

void performer_init(performer_t *performer, const page_source_t *source, servo_link_t *servos,
                    const settings_t *settings)
{
    memset(performer, 0, sizeof *performer);
    performer->servos = servos;
    performer->settings = settings;
    shape_init(&performer->shape);
    performer_set_source(performer, source);
}

void performer_set_source(performer_t *performer, const page_source_t *source)
{
    performer->source = source;
    fresh_player(performer);
}

/* ---- state ---- */

bool performer_is_still(const performer_t *performer)
{
    return performer_is_idle(performer) && !performer_layers_are_moving(performer);
}

bool performer_next_event(performer_t *performer, performer_event_t *event)
{
    return performer_event_take(&performer->events, event);
}

uint8_t *performer_spare(performer_t *performer)
{
    STATIC_ASSERT(sizeof performer->joint >= PAGE_BYTES, "a page fits into the joints of the player");
    return performer_is_idle(performer) ? (uint8_t *)performer->joint : NULL;
}

/* ---- start ---- */

/* Starts a fresh player at `page` from the current goals, with the law of the settings. */
static player_status_t start_player(performer_t *performer, uint8_t page, uint32_t joints)
{
    const player_law_t law = performer->settings->law == PLAYER_LAW_CLASSIC ? PLAYER_LAW_CLASSIC : PLAYER_LAW_EXACT;
    fresh_player(performer);
    return player_start(&performer->player, &performer->link, page, law, performer->goal_pos, joints);
}

/* PERFORMER_OK if at least one of `joints` can move now. */
static performer_status_t somebody_can_move(const performer_t *performer, uint32_t joints)
{
    if (!performer_is_idle(performer)) {
        return PERFORMER_ERR_BUSY;
    }
    if ((performer->servos->present & joints) == 0) {
        return PERFORMER_ERR_NO_SERVOS;
    }
    return (performer_usable(performer) & joints) == 0 ? PERFORMER_ERR_RELEASED : PERFORMER_OK;
}

/* The other joints are not asked for, and keep their torque as it is. */
static void get_ready(performer_t *performer, uint32_t joints)
{
    performer->ready_left = performer_usable(performer) & joints;
    performer->joints = 0;
    performer->faulty = 0;
    performer->leaving = false;
    performer->battery_reported = false;
    performer->is_hot = false;   /* a hot servo is named again in each play */
    performer->since_stop_ticks = UINT8_MAX;
    performer->end_reason = PERFORMER_END_DONE;
    performer->state = PERFORMER_READY;
}

static performer_status_t refusal(performer_t *performer, player_status_t status)
{
    performer->fault = performer->player.fault;
    performer->fault_page = performer->player.fault_page;
    STATIC_ASSERT((int)PERFORMER_ERR_RANGE == (int)PLAYER_ERR_RANGE && (int)PERFORMER_ERR_PAGE == (int)PLAYER_ERR_PAGE &&
                      (int)PERFORMER_ERR_EMPTY == (int)PLAYER_ERR_EMPTY && (int)PERFORMER_ERR_BUSY == (int)PLAYER_ERR_BUSY &&
                      (int)PERFORMER_ERR_LAW == (int)PLAYER_ERR_LAW,
                  "the performer's errors begin with the player's");
    return (performer_status_t)status;
}

static NOINLINE void call_link(performer_t *performer, uint8_t code)
{
    STATIC_ASSERT((int)SETTINGS_REMOTE_LATCH == (int)LINK_LATCH && (int)SETTINGS_REMOTE_HOLD == (int)LINK_HOLD &&
                      (int)SETTINGS_REMOTE_DRIVE == (int)LINK_DRIVE,
                  "the setting is the mode");
    link_init(&performer->link, (link_mode_t)performer->settings->remote_mode);
    link_call(&performer->link, code);
}

performer_status_t performer_start(performer_t *performer, uint8_t page, uint8_t code)
{
    performer_status_t status = somebody_can_move(performer, SERVO_LINK_ALL);
    if (status != PERFORMER_OK) {
        return status;
    }
    /* Starts a player without joints, to learn whether it accepts the page. */
    performer_shape_follow(performer);
    call_link(performer, code);
    status = refusal(performer, start_player(performer, page, 0));
    performer->first_page = performer->player.next.page;
    fresh_player(performer);
    if (status != PERFORMER_OK) {
        return status;
    }
    call_link(performer, code);
    performer->page = page;
    performer->move_deg_s = 0;
    get_ready(performer, SERVO_LINK_ALL);
    return PERFORMER_OK;
}

performer_status_t performer_move(performer_t *performer, const uint16_t to_pos[PAGE_JOINTS], uint32_t joints,
                                  uint16_t deg_s)
{
    const performer_status_t status = somebody_can_move(performer, joints);
    if (status != PERFORMER_OK) {
        return status;
    }
    performer_layers_drop(performer, joints);   /* the newest command wins: code no longer moves them */
    memcpy(performer->player.next_pos, to_pos, sizeof performer->player.next_pos);
    performer->page = 0;
    performer->move_deg_s = deg_s;
    get_ready(performer, joints);
    return PERFORMER_OK;
}

/* ---- end ---- */

/* Ends everything; reports performer_end_t. */
static void go_idle(performer_t *performer, uint8_t reason)
{
    const player_t *player = &performer->player;
    const uint8_t page_fault = performer->state == PERFORMER_PLAY ? player->fault : PAGE_OK;
    if (page_fault != PAGE_OK) {
        performer->page = player->fault_page;
    }
    performer->state = PERFORMER_IDLE;
    performer_layers_bind(performer, false);
    if (reason != PERFORMER_END_DONE && reason != PERFORMER_END_THERE) {
        performer_layers_break(performer);
    }
    performer_drive_end(performer);
    performer_event_put(&performer->events, PERFORMER_EV_ENDED, performer->page, page_fault, reason);
}

/* ---- stop, break ---- */

static void resume_if_paused(performer_t *performer)
{
    if (player_is_paused(&performer->player)) {
        player_resume(&performer->player);
        performer_layers_pause(performer, false);
        performer_layers_plan(performer);
    }
}

/* State PLAY: stops through the exit page; ends a pause. */
static void stop_softly(performer_t *performer)
{
    link_stop(&performer->link);
    resume_if_paused(performer);
}

void performer_break(performer_t *performer)
{
    performer->since_stop_ticks = 0;
    performer_layers_break(performer);
    if (performer_is_idle(performer) || performer->leaving) {
        return;
    }
    performer->leaving = true;
    if (performer->end_reason == PERFORMER_END_DONE) {
        performer->end_reason = PERFORMER_END_BROKEN;
    }
    if (performer->state > PERFORMER_READY) {
        player_break(&performer->player);
        performer_layers_plan(performer);
    }
}

/* Registers a stop. true: it was the second within a second, or came before the first step, and is now a break. */
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
        stop_softly(performer);
    }
}

/* performer_drive came too late: stops the play. */
static void drive_lost(performer_t *performer)
{
    if (performer_is_idle(performer)) {
        performer_drive_end(performer);
        return;
    }
    performer_event_put(&performer->events, PERFORMER_EV_DRIVE_LOST, 0, 0, 0);
    if (performer->state == PERFORMER_PLAY) {
        stop_softly(performer);
    } else {
        performer_break(performer);
    }
}

void performer_stop_without_exit(performer_t *performer)
{
    if (performer->state != PERFORMER_PLAY) {
        performer_break(performer);
        return;
    }
    link_end(&performer->link);
    resume_if_paused(performer);
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
    /* The button was released before the first step: there is no page yet whose exit could be played. */
    if (performer->state != PERFORMER_PLAY && link_is_stopping(&performer->link)) {
        performer_break(performer);
    }
}

/* ---- pause ---- */

bool performer_pause(performer_t *performer)
{
    if (performer->leaving || performer->move_deg_s != 0 || performer->state <= PERFORMER_READY ||
        performer_is_paused(performer)) {
        return false;
    }
    performer_layers_pause(performer, true);
    player_pause(&performer->player);
    performer_layers_plan(performer);
    return true;
}

bool performer_resume(performer_t *performer)
{
    if (performer->leaving || !performer_is_paused(performer)) {
        return false;
    }
    resume_if_paused(performer);
    return true;
}

/* ---- torque ---- */

/* Takes joints out of the play and its layers. */
static void drop(performer_t *performer, uint32_t joints)
{
    performer->joints &= ~joints;
    performer->ready_left &= ~joints;
    performer_layers_drop(performer, joints);
    if (performer->state > PERFORMER_READY) {
        player_drop_joints(&performer->player, joints);
    }
}

uint32_t performer_on(performer_t *performer, uint32_t joints)
{
    if (!performer_is_idle(performer)) {
        return 0;
    }
    const uint32_t on = servo_link_torque_on(performer->servos, joints);
    performer->released &= ~on;
    performer->faulty &= ~on;
    return on;
}

/* Takes joints out of the play until performer_on; a play without joints ends. */
static void release(performer_t *performer, uint32_t joints)
{
    performer->released |= joints;
    drop(performer, joints);
    if ((performer->joints | performer->ready_left) == 0) { /* no joint is left to move */
        performer->since_stop_ticks = 0;
        if (!performer_is_idle(performer)) {
            go_idle(performer, PERFORMER_END_BROKEN);
        }
    }
}

uint32_t performer_off(performer_t *performer, uint32_t joints)
{
    release(performer, joints);
    return servo_link_torque_off(performer->servos, joints);
}

/* ---- state transitions ---- */

/* Begins the play, or ends the move: every joint is in position. The play begins with first_page, whatever code came since
 * the start: the approach went there. */
static void begin(performer_t *performer)
{
    if (performer->move_deg_s != 0) {
        go_idle(performer, PERFORMER_END_THERE);
        return;
    }
    performer->state = PERFORMER_PLAY;
    performer->slopes_due = false;
    const player_status_t status = start_player(performer, performer->first_page, performer->joints);
    performer_layers_bind(performer, true);
    if (status != PLAYER_OK) {
        go_idle(performer, PERFORMER_END_PAGE);
        return;
    }
    performer_layers_plan(performer);
}

bool performer_engage(performer_t *performer, uint8_t id)
{
    if (servo_link_engage(performer->servos, id, &performer->goal_pos[id])) {
        return true;
    }
    servo_link_put(&performer->faulty, id, true);
    performer_event_put(&performer->events, PERFORMER_EV_UNREADY, id, servo_link_has(&performer->servos->outside, id), 0);
    return false;
}

/* READY: asks one servo. false: it does not answer or obey, and the rule for faults ends the play. */
static bool ask_one_joint(performer_t *performer)
{
    const uint8_t id = servo_link_lowest(&performer->ready_left);
    const uint32_t joint = servo_link_bit(id);
    const bool of_layer = (performer_layers_joints(performer) & joint) != 0;
    servo_link_put(&performer->ready_left, id, false);
    if (!of_layer && !performer_engage(performer, id)) { /* a layer keeps its goal up to date */
        return performer->settings->fault_rule == SETTINGS_FAULT_LIMP;
    }
    servo_link_put(&performer->joints, id, true);
    return true;
}

/* Puts the target of the approach, the positions of the first step, into next_pos. For a move it is there already.
 * Returns the joints that have a target. */
static uint32_t take_first_pose(performer_t *performer)
{
    uint16_t *to_pos = performer->player.next_pos;
    uint32_t joints = performer->joints & ~performer_layers_joints(performer);
    if (performer->move_deg_s == 0) {
        joints &= player_first_pose(performer->source, &performer->shape, performer->first_page, to_pos);
    }
    return joints;
}

/* A servo that holds may stand that far from its goal. A play whose joints are so near begins without an approach. */
#define NEAR_POS 3u

/* Plans the approach or move and queues its event. false: there is no approach, or the joints are there already. */
static bool plan_approach(performer_t *performer)
{
    const bool is_move = performer->move_deg_s != 0;
    const uint16_t limit_deg_s = is_move ? performer->move_deg_s : performer->settings->approach_deg_s;
    if (limit_deg_s == 0) {
        return false;
    }
    const uint32_t joints = take_first_pose(performer);
    const uint16_t ticks = player_move(&performer->player, performer->goal_pos, joints, limit_deg_s,
                                       is_move ? 0 : NEAR_POS);
    if (ticks == 0) {
        return false;
    }
    const uint16_t seconds = (uint16_t)((ticks + PLAYER_TICKS_PER_SECOND - 1) / PLAYER_TICKS_PER_SECOND);
    performer_event_put(&performer->events, PERFORMER_EV_APPROACH, performer->page,
                        (uint8_t)(seconds > UINT8_MAX ? UINT8_MAX : seconds), 0);
    return true;
}

static void poll_ready(performer_t *performer)
{
    if (performer->leaving) {
        go_idle(performer, performer->end_reason);
    } else if (performer->ready_left != 0) {
        if (!ask_one_joint(performer)) {
            go_idle(performer, PERFORMER_END_SERVO);
        }
    } else if (performer->joints == 0) {
        go_idle(performer, PERFORMER_END_SERVO);
    } else {
        if (plan_approach(performer)) {
            performer->state = PERFORMER_APPROACH;
        } else {
            begin(performer);
        }
        tick_forgive();   /* asking servos and planning is slow, but nothing has moved: the first goals are on time */
    }
}

static uint8_t why_ended(const performer_t *performer)
{
    const player_t *player = &performer->player;
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
    drop(performer, joint);
    if (verdict == WATCH_LIMP) {
        (void)servo_link_torque_off(performer->servos, joint);
        servo_link_assume_on(performer->servos, joint);
        return;
    }
    performer->end_reason = PERFORMER_END_SERVO; /* used only during a play or move */
    if (verdict == WATCH_EXIT) {
        stop_softly(performer);
    } else {
        performer_break(performer);
    }
}

/* Events that only a PC has; on a board both functions return a constant. */
static void watch_computer(performer_t *performer)
{
    if (bus_was_lost()) {
        performer_event_put(&performer->events, PERFORMER_EV_BUS_LOST, 0, 0, 0);
        release(performer, SERVO_LINK_ALL);
        servo_link_assume_off(performer->servos);
    }
    if (system_is_asked_to_end()) {
        performer_break(performer);
        if (performer_is_still(performer)) {
            system_end();
        }
    }
}

void performer_poll(performer_t *performer)
{
    uint32_t failed;
    servo_link_poll(performer->servos);
    watch_computer(performer);
    const performer_verdict_t verdict = performer_watch(performer, &failed);
    if (verdict != WATCH_GO_ON) { /* one per turn: it may block for 3 ms */
        act_on(performer, verdict, failed);
    }
    if (performer->state == PERFORMER_READY) {
        poll_ready(performer);
    }
}

/* ---- the tick ---- */

static void send_goals(performer_t *performer, uint32_t joints)
{
    servo_link_goals(performer->servos, performer->goal_pos, joints | performer_layers_joints(performer));
}

/* Sets the compliance bytes of the playing pages. NOINLINE: inlined, every tick would need 31 more bytes of stack. */
static NOINLINE void set_slopes(performer_t *performer)
{
    uint8_t compliance[PAGE_JOINTS];
    performer->source->read(performer->source->context, performer->player.now.page, PAGE_AT_COMPLIANCE, compliance,
                            sizeof compliance);
    performer_layers_slopes(performer, compliance);
    servo_link_slopes(performer->servos, compliance);
}

static void approach_tick(performer_t *performer)
{
    player_t *player = &performer->player;
    const uint8_t events = player_tick(player, NULL);
    if (((events | performer_layers_tick(performer, false)) & PLAYER_EV_OUTPUT) != 0) {
        player_goals(player, player->joints, performer->goal_pos);
        send_goals(performer, player->joints);
    }
    if ((events & PLAYER_EV_ENDED) != 0 && performer->leaving) {
        go_idle(performer, performer->end_reason);
    } else if ((events & PLAYER_EV_ENDED) != 0) {
        /* Joints that code has freed meanwhile still have to move to the first pose, and shaping may have changed it. */
        if (!plan_approach(performer)) {
            begin(performer);
        }
    } else if ((events & PLAYER_EV_STOPPED) != 0) {
        performer_event_put(&performer->events, PERFORMER_EV_PAUSED, performer->page, 0, 0);
    }
}

/* Queues the player's events of this tick. */
static void tell(performer_t *performer, uint8_t events)
{
    const player_t *player = &performer->player;
    if ((events & PLAYER_EV_STEP) != 0) {
        performer->page = player->now.page;
        performer_event_put(&performer->events, PERFORMER_EV_STEP, player->now.page, player->now.step, player->repetition);
    }
    if ((events & PLAYER_EV_LINK) != 0) {
        performer_event_put(&performer->events, PERFORMER_EV_LINK, player->link_page, player->link_taken, 0);
    }
    if ((events & PLAYER_EV_ENDED) != 0 || ((events & PLAYER_EV_STOPPED) != 0 && performer->leaving)) {
        go_idle(performer, why_ended(performer));
    } else if ((events & PLAYER_EV_STOPPED) != 0) {
        performer_event_put(&performer->events, PERFORMER_EV_PAUSED, performer->page, 0, 0);
    }
}

/* Sends the goals first and does the rest afterwards, so that the goals of every tick leave at the same time. */
static void play_tick(performer_t *performer)
{
    const uint8_t events = performer_layers_tick(performer, true);
    if ((events & PLAYER_EV_OUTPUT) != 0) {
        send_goals(performer, performer->player.joints);
    }
    if ((events & PLAYER_EV_PAGE) != 0 || performer->slopes_due) {
        performer->slopes_due = false;
        set_slopes(performer);
    }
    tell(performer, events);
    if (performer->state == PERFORMER_PLAY) {
        performer_layers_plan(performer);
    }
}

static void idle_tick(performer_t *performer)
{
    if ((performer_layers_tick(performer, false) & PLAYER_EV_OUTPUT) != 0) {
        send_goals(performer, 0);
    }
}

/* Breaks off after too long a gap between goals, because motion would resume with a jerk. */
static void watch_ticks(performer_t *performer)
{
    if (tick_late() >= LATE_TICKS && !performer->leaving && performer->state != PERFORMER_READY &&
        !performer_is_still(performer)) {
        performer_event_put(&performer->events, PERFORMER_EV_TICKS_LATE, 0, 0, 0);
        performer_break(performer);
    }
}

void performer_tick(performer_t *performer)
{
    servo_link_tick(performer->servos);
    watch_ticks(performer);
    if (performer->since_stop_ticks < UINT8_MAX) {
        performer->since_stop_ticks++;
    }
    if (performer_drive_is_lost(performer)) {
        drive_lost(performer);
    }
    if (performer->state == PERFORMER_APPROACH) {
        approach_tick(performer);
    } else if (performer->state == PERFORMER_PLAY) {
        play_tick(performer);
    } else {
        idle_tick(performer);
    }
}
