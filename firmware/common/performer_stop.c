/* SPDX-License-Identifier: MIT
 * performer_stop.c - ends a play or interrupts it: stop, break, pause, torque off. */
#include "performer_parts.h"

#include "bound.h"
#include "performer_shape.h"

#define SECOND_STOP_TICKS PLAYER_TICKS_PER_SECOND

void performer_go_idle(performer_t *performer, uint8_t reason)
{
    uint8_t page_fault = PAGE_OK;
    if (performer->state == PERFORMER_PLAY) {
        const player_t *player = &performer->engine.player;
        performer->page = player->fault != PAGE_OK ? player->fault_page : player->page;
        page_fault = player->fault;
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
    if (player_is_paused(&performer->engine.player)) {
        player_resume(&performer->engine.player);
        performer_layers_pause(performer, false);
    }
}

void performer_stop_softly(performer_t *performer)
{
    link_stop(&performer->link);
    resume_if_paused(performer);
}

void performer_break(performer_t *performer)
{
    performer_layers_break(performer);
    if (performer_is_idle(performer) || performer->leaving) {
        return;
    }
    performer->leaving = true;
    if (performer->end_reason == PERFORMER_END_DONE) {
        performer->end_reason = PERFORMER_END_BROKEN;
    }
    if (performer->state == PERFORMER_APPROACH) {
        approach_break(&performer->engine.approach);
    } else if (performer->state == PERFORMER_APPROACH_PAUSED) {
        performer_go_idle(performer, performer->end_reason);
    } else if (performer->state == PERFORMER_PLAY) {
        player_break(&performer->engine.player);
    }
}

/* Counts a stop. true: it was the second within a second, or came before the first step, and was carried out as a break. */
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

void performer_drive_lost(performer_t *performer)
{
    if (performer_is_idle(performer)) {
        performer_drive_end(performer);
        return;
    }
    performer_event_put(&performer->events, PERFORMER_EV_DRIVE_LOST, 0, 0, 0);
    if (performer->state == PERFORMER_PLAY) {
        performer_stop_softly(performer);
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
    /* A hand that lets go before the first step: there is no page yet to leave softly. */
    if (performer->state != PERFORMER_PLAY && link_is_stopping(&performer->link)) {
        performer_break(performer);
    }
}

/* ---- pause ---- */

bool performer_pause(performer_t *performer)
{
    if (performer->leaving || performer->move_deg_s != 0 || performer_is_paused(performer)) {
        return false;
    }
    if (performer->state == PERFORMER_PLAY) {
        performer_layers_pause(performer, true);
        player_pause(&performer->engine.player);
        return true;
    }
    if (performer->state == PERFORMER_APPROACH && !performer->pausing) {
        performer->pausing = true;
        performer_layers_pause(performer, true);
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
    performer_layers_pause(performer, false);
    if (performer->state == PERFORMER_PLAY) {
        player_resume(&performer->engine.player);
    } else {
        performer_get_ready(performer);
    }
    return true;
}

/* ---- torque ---- */

NOINLINE void performer_drop(performer_t *performer, uint32_t joints)
{
    performer->joints &= ~joints;
    performer->ready_left &= ~joints;
    performer_layers_drop(performer, joints);
    if (performer->state == PERFORMER_PLAY) {
        player_drop_joints(&performer->engine.player, joints);
    }
}

uint32_t performer_on(performer_t *performer, uint32_t joints)
{
    if (!performer_is_idle(performer)) {
        return 0;
    }
    const uint32_t on = servo_link_torque_on(PERFORMER_SERVOS(performer), joints);
    performer->released &= ~on;
    performer->faulty &= ~on;
    return on;
}

void performer_off(performer_t *performer, uint32_t joints)
{
    performer->released |= joints;
    performer_drop(performer, joints);
    servo_link_torque_off(PERFORMER_SERVOS(performer), joints);
    if (!performer_is_idle(performer) && (performer->joints | performer->ready_left) == 0) {
        performer_go_idle(performer, PERFORMER_END_BROKEN); /* no joint is left to move */
    }
}
