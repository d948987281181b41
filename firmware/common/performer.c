/* SPDX-License-Identifier: MIT
 * performer.c - the work of the main loop and of the tick; from one state to the next. */
#include "performer.h"

#include <string.h>
#include "bound.h"
#include "performer_parts.h"
#include "performer_shape.h"

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
    performer_fresh_player(performer);
}

/* ---- what it is doing ---- */

bool performer_is_still(const performer_t *performer)
{
    return performer_is_idle(performer) && !performer_layers_are_moving(performer);
}

bool performer_next_event(performer_t *performer, performer_event_t *event)
{
    return performer_event_take(&performer->events, event);
}

/* The memory at the end of the player: not used by the approach, nor by goals that servo_link may still be sending. */
uint8_t *performer_spare(performer_t *performer)
{
    STATIC_ASSERT(sizeof performer->engine.player + PAGE_BYTES <= sizeof performer->engine &&
                      sizeof performer->engine.approach + PAGE_BYTES <= sizeof performer->engine,
                  "the spare bytes are the joints' of the player");
    return performer_is_idle(performer) ? (uint8_t *)(&performer->engine + 1) - PAGE_BYTES : NULL;
}

/* ---- from one state to the next ---- */

/* Begins the play, or ends the move: every joint is at its place. */
static void begin(performer_t *performer)
{
    if (performer->move_deg_s != 0) {
        performer_go_idle(performer, PERFORMER_END_THERE);
        return;
    }
    performer->state = PERFORMER_PLAY;
    performer->slopes_due = false;
    performer_fresh_player(performer);
    performer_layers_bind(performer, true);
    if (performer_start_player(performer, performer->page, performer->joints) != PLAYER_OK) {
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
        performer->state = PERFORMER_APPROACH_PAUSED;
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
    performer->end_reason = PERFORMER_END_SERVO; /* used if a play is on */
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

static void send_goals(performer_t *performer, uint32_t joints)
{
    servo_link_goals(PERFORMER_SERVOS(performer), performer->goal_pos, joints | performer_layers_joints(performer));
}

/* Sends the compliance bytes of the pages that play. NOINLINE: else every tick would need 31 bytes of stack for what happens
 * once a page. */
static NOINLINE void send_slopes(performer_t *performer)
{
    uint8_t compliance[PAGE_JOINTS];
    performer->source->read(performer->source->context, performer->engine.player.page, PAGE_AT_COMPLIANCE, compliance,
                            sizeof compliance);
    performer_layers_slopes(performer, compliance);
    servo_link_slopes(PERFORMER_SERVOS(performer), compliance);
}

static void approach_or_move_tick(performer_t *performer)
{
    const bool under_way = approach_tick(&performer->engine.approach, performer->goal_pos);
    (void)performer_layers_tick(performer, false);
    send_goals(performer, performer->engine.approach.joints & performer->joints);
    if (!under_way) {
        approach_over(performer);
    }
}

/* Queues the player's events of this tick. */
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

/* A page's slopes go out a tick or more after its first goals, because the tick in which a page begins is a long one. */
static void play_tick(performer_t *performer)
{
    const bool slopes_due = performer->slopes_due;
    const uint8_t events = performer_layers_tick(performer, true);
    if ((events & PLAYER_EV_PAGE) != 0) {
        performer->slopes_due = true;
    } else if (slopes_due) {
        performer->slopes_due = false;
        send_slopes(performer);
    }
    if ((events & PLAYER_EV_OUTPUT) != 0) {
        send_goals(performer, performer->engine.player.joints);
    }
    if ((events & PLAYER_EV_STEP) != 0) {
        servo_link_delay_slopes(PERFORMER_SERVOS(performer));
    }
    tell(performer, events);
}

static void idle_tick(performer_t *performer)
{
    if ((performer_layers_tick(performer, false) & PLAYER_EV_OUTPUT) != 0) {
        send_goals(performer, 0);
    }
}

void performer_tick(performer_t *performer)
{
    servo_link_tick(PERFORMER_SERVOS(performer));
    if (performer->since_stop_ticks < UINT8_MAX) {
        performer->since_stop_ticks++;
    }
    if (performer_drive_is_lost(performer)) {
        performer_drive_lost(performer);
    }
    if (performer->state == PERFORMER_APPROACH) {
        approach_or_move_tick(performer);
    } else if (performer->state == PERFORMER_PLAY) {
        play_tick(performer);
    } else {
        idle_tick(performer);
    }
}
