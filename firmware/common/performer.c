/* SPDX-License-Identifier: MIT */
#include "performer.h"

#include <string.h>
#include "bus_call.h"

#define SECOND_STOP_TICKS PLAYER_TICKS_PER_SECOND
#define BATTERY_BACK_DV 3u   /* the voltage must rise by this much before it can be low anew */
#define HOT_BACK_DEGREES 3u
#define EVENTS_FOR_STEPS (PERFORMER_EVENTS - 6u) /* room kept for rarer and graver events */
#define POSE_UNKNOWN_POS 512u /* stands for the pose of joints that nobody drives */

/* What the fault rule acts on. A voltage error is told but ends nothing: the battery is low long before it is empty. */
#define ERRORS_GRAVE (DXL_ERR_ANGLE | DXL_ERR_HEAT | DXL_ERR_OVERLOAD)

/* ---- events ---- */

static void tell(performer_t *performer, uint8_t kind, uint8_t a, uint8_t b, uint8_t c)
{
    const uint8_t room_for = kind == PERFORMER_EV_STEP ? EVENTS_FOR_STEPS : PERFORMER_EVENTS;
    if (performer->events_count >= room_for) {
        performer->events_lost = (uint8_t)(performer->events_lost + (performer->events_lost < UINT8_MAX ? 1 : 0));
        return;
    }
    const uint8_t at = (uint8_t)((performer->events_head + performer->events_count) % PERFORMER_EVENTS);
    performer->events[at] = (performer_event_t){.kind = kind, .a = a, .b = b, .c = c};
    performer->events_count++;
}

bool performer_next_event(performer_t *performer, performer_event_t *event)
{
    if (performer->events_count == 0) {
        if (performer->events_lost == 0) {
            return false;
        }
        *event = (performer_event_t){.kind = PERFORMER_EV_LOST, .a = performer->events_lost};
        performer->events_lost = 0;
        return true;
    }
    *event = performer->events[performer->events_head];
    performer->events_head = (uint8_t)((performer->events_head + 1u) % PERFORMER_EVENTS);
    performer->events_count--;
    return true;
}

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

bool performer_is_paused(const performer_t *performer)
{
    return performer->state == PERFORMER_STOOD ||
           (performer->state == PERFORMER_PLAY && player_is_paused(&performer->engine.player));
}

static void finish(performer_t *performer, uint8_t end)
{
    uint8_t page_fault = PAGE_OK;
    if (performer->state == PERFORMER_PLAY) {
        const player_t *player = &performer->engine.player;
        performer->page = player->fault != PAGE_OK ? player->fault_page : player->page;
        page_fault = player->fault;
    }
    performer->state = PERFORMER_IDLE;
    tell(performer, PERFORMER_EV_ENDED, performer->page, page_fault, end);
}

static player_law_t law(const performer_t *performer)
{
    return performer->settings->law == PLAYER_LAW_CLASSIC ? PLAYER_LAW_CLASSIC : PLAYER_LAW_EXACT;
}

/* Joints that answer the bus and were not switched off by hand. */
static uint32_t usable(const performer_t *performer)
{
    return performer->servos->present & ~performer->released;
}

static performer_status_t somebody_can_move(const performer_t *performer)
{
    if (!performer_is_idle(performer)) {
        return PERFORMER_ERR_BUSY;
    }
    if (performer->servos->present == 0) {
        return PERFORMER_ERR_NO_SERVOS;
    }
    return usable(performer) == 0 ? PERFORMER_ERR_RELEASED : PERFORMER_OK;
}

static void get_ready(performer_t *performer)
{
    performer->ready_left = usable(performer);
    performer->joints = 0;
    performer->leaving = false;
    performer->pausing = false;
    performer->end = PERFORMER_END_DONE;
    performer->state = PERFORMER_READY;
}

static performer_status_t refusal(performer_t *performer, player_status_t status)
{
    performer->fault = performer->engine.player.fault;
    switch (status) {
    case PLAYER_OK:
        return PERFORMER_OK;
    case PLAYER_ERR_RANGE:
        return PERFORMER_ERR_RANGE;
    case PLAYER_ERR_PAGE:
        return PERFORMER_ERR_PAGE;
    case PLAYER_ERR_EMPTY:
        return PERFORMER_ERR_EMPTY;
    default:
        return PERFORMER_ERR_BUSY;
    }
}

/* Binds the player anew and starts it at `page` from pose_pos. */
static player_status_t start_player(performer_t *performer, uint8_t page, uint32_t joints)
{
    player_t *player = &performer->engine.player;
    player_init(player, performer->source);
    return player_start(player, &performer->link, page, law(performer), performer->pose_pos, joints);
}

performer_status_t performer_start(performer_t *performer, uint8_t page, uint8_t code)
{
    performer_status_t status = somebody_can_move(performer);
    if (status != PERFORMER_OK) {
        return status;
    }
    link_init(&performer->link, performer->settings->remote_mode == LINK_HOLD ? LINK_HOLD : LINK_LATCH);
    link_call(&performer->link, code);
    /* A start without joints: only to hear what the player has against this page. */
    const link_t called = performer->link;
    status = refusal(performer, start_player(performer, page, 0));
    performer->link = called;
    if (status != PERFORMER_OK) {
        player_init(&performer->engine.player, performer->source);
        return status;
    }
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

/* ---- faults ---- */

static void drop(performer_t *performer, uint32_t joints)
{
    performer->joints &= ~joints;
    performer->ready_left &= ~joints;
    if (performer->state == PERFORMER_PLAY) {
        player_drop_joints(&performer->engine.player, joints);
    }
}

/* Through the exit page; a pause ends. */
static void stop_softly(performer_t *performer)
{
    link_stop(&performer->link);
    if (player_is_paused(&performer->engine.player)) {
        player_resume(&performer->engine.player);
    }
}

/* The rule of the settings, for one joint of this play. */
static void act_on_fault(performer_t *performer, uint32_t joint)
{
    if (performer_is_idle(performer) || ((performer->joints | performer->ready_left) & joint) == 0) {
        return;
    }
    drop(performer, joint);
    if (performer->settings->fault_rule == SETTINGS_FAULT_LIMP) {
        servo_link_torque_off(performer->servos, joint);
        return;
    }
    performer->end = PERFORMER_END_SERVO;
    if (performer->settings->fault_rule == SETTINGS_FAULT_EXIT && performer->state == PERFORMER_PLAY) {
        stop_softly(performer);
    } else {
        performer_break(performer);
    }
}

static void take_faults(performer_t *performer)
{
    servo_fault_t fault;
    while (servo_link_next_fault(performer->servos, &fault)) {
        const uint32_t joint = SERVO_LINK_BIT(fault.id);
        if (fault.kind == SERVO_FAULT_BACK) {
            performer->faulty &= ~joint;
            tell(performer, PERFORMER_EV_BACK, fault.id, 0, 0);
        } else if (fault.kind == SERVO_FAULT_SILENT) {
            performer->faulty |= joint;
            tell(performer, PERFORMER_EV_SILENT, fault.id, 0, 0);
            act_on_fault(performer, joint);
        } else if (fault.errors == 0) {
            performer->faulty &= ~joint;
        } else {
            performer->faulty |= joint;
            tell(performer, PERFORMER_EV_ERRORS, fault.id, fault.errors, 0);
            if ((fault.errors & ERRORS_GRAVE) != 0) {
                act_on_fault(performer, joint);
            }
        }
    }
}

/* Told once, and again only after it was good for a while. */
static void watch_battery(performer_t *performer)
{
    const uint8_t limit_dv = performer->settings->battery_low_dv;
    const uint8_t now_dv = performer->servos->voltage_dv;
    if (now_dv == 0 || limit_dv == 0) {
        return;
    }
    if (now_dv < limit_dv && !performer->told_battery) {
        performer->told_battery = true;
        tell(performer, PERFORMER_EV_BATTERY, now_dv, 0, 0);
    } else if (now_dv >= limit_dv + BATTERY_BACK_DV) {
        performer->told_battery = false;
    }
}

static void watch_heat(performer_t *performer)
{
    const uint8_t limit = performer->settings->hot_degrees;
    const uint8_t now = performer->servos->hottest_degrees;
    if (limit == 0) {
        return;
    }
    if (now >= limit && !performer->told_hot) {
        performer->told_hot = true;
        tell(performer, PERFORMER_EV_HOT, performer->servos->hottest_id, now, 0);
    } else if (now + HOT_BACK_DEGREES < limit) {
        performer->told_hot = false;
    }
}

/* ---- READY: pose and torque, one joint a call ---- */

static uint8_t lowest_joint(uint32_t joints)
{
    uint8_t id = 0;
    while ((joints & 1u) == 0) {
        joints >>= 1;
        id++;
    }
    return id;
}

static void ask_one_joint(performer_t *performer)
{
    const uint8_t id = lowest_joint(performer->ready_left);
    const uint32_t joint = SERVO_LINK_BIT(id);
    performer->ready_left &= ~joint;
    servo_link_t *servos = performer->servos;
    const uint32_t answered = (servos->torque & joint) != 0 ? servo_link_read_pose(servos, joint)
                                                            : servo_link_torque_on(servos, joint);
    if (answered != 0) {
        performer->joints |= joint;
        performer->pose_pos[id] = servos->present_pos[id];
        return;
    }
    performer->faulty |= joint;
    tell(performer, PERFORMER_EV_SILENT, id, 0, 0);
    if (performer->settings->fault_rule != SETTINGS_FAULT_LIMP) {
        finish(performer, PERFORMER_END_SERVO);
    }
}

static void begin_page(performer_t *performer)
{
    performer->state = PERFORMER_PLAY;
    if (start_player(performer, performer->page, performer->joints) != PLAYER_OK) {
        finish(performer, PERFORMER_END_PAGE);
    }
}

/* Where the approach leads: the first step's positions, or the pose of a move. Returns the joints it concerns. */
static uint32_t first_pose(const performer_t *performer, uint16_t to_pos[PAGE_JOINTS])
{
    memcpy(to_pos, performer->pose_pos, sizeof performer->pose_pos);
    uint32_t joints = 0;
    for (uint8_t id = 0; id < PAGE_JOINTS; id++) {
        const uint32_t joint = SERVO_LINK_BIT(id);
        uint16_t word = PAGE_POS_UNUSED;
        if ((performer->joints & joint) == 0) {
            continue;
        }
        if (performer->move_deg_s == 0) {
            uint8_t bytes[2];
            performer->source->read(performer->source->context, performer->first_page,
                                    (uint16_t)(PAGE_AT_STEP0 + 2u * id), bytes, sizeof bytes);
            word = (uint16_t)(bytes[0] | (bytes[1] << 8));
        } else if ((performer->move_joints & joint) != 0) {
            word = performer->engine.approach.target_pos[id];
        }
        if (page_pos_is_used(word)) {
            to_pos[id] = word;
            joints |= joint;
        }
    }
    return joints;
}

static void begin_approach(performer_t *performer)
{
    static const uint8_t full_speed[2] = {0, 0};
    if (performer->joints == 0) {
        finish(performer, PERFORMER_END_SERVO);
        return;
    }
    /* The editor leaves slow moving speeds behind; goals a tick apart need the servos' full one. Nobody answers, so there
     * is nothing to check. */
    servo_link_quiet(performer->servos);
    (void)!bus_call_write(DXL_BROADCAST, DXL_AT_SPEED, full_speed, sizeof full_speed, NULL);
    uint16_t to_pos[PAGE_JOINTS];
    const uint32_t joints = first_pose(performer, to_pos);
    const uint16_t limit_deg_s =
        performer->move_deg_s != 0 ? performer->move_deg_s : performer->settings->approach_deg_s;
    uint16_t ticks = 0;
    if (performer->move_deg_s != 0 || !performer->approach_off) {
        ticks = approach_start(&performer->engine.approach, performer->pose_pos, to_pos, joints, limit_deg_s);
    }
    if (ticks > 0) {
        const uint16_t seconds = (uint16_t)((ticks + PLAYER_TICKS_PER_SECOND - 1) / PLAYER_TICKS_PER_SECOND);
        performer->state = PERFORMER_APPROACH;
        tell(performer, PERFORMER_EV_APPROACH, performer->page, (uint8_t)(seconds > UINT8_MAX ? UINT8_MAX : seconds), 0);
    } else if (performer->move_deg_s != 0) {
        finish(performer, PERFORMER_END_THERE);
    } else {
        begin_page(performer);
    }
}

void performer_poll(performer_t *performer)
{
    servo_link_poll(performer->servos);
    take_faults(performer);
    watch_battery(performer);
    watch_heat(performer);
    if (performer->state != PERFORMER_READY) {
        return;
    }
    if (performer->leaving) {
        finish(performer, performer->end);
    } else if (performer->ready_left != 0) {
        ask_one_joint(performer);
    } else {
        begin_approach(performer);
    }
}

/* ---- the tick ---- */

static void approach_over(performer_t *performer)
{
    if (performer->leaving) {
        finish(performer, performer->end);
    } else if (performer->pausing) {
        performer->state = PERFORMER_STOOD;
        tell(performer, PERFORMER_EV_PAUSED, performer->page, 0, 0);
    } else if (performer->move_deg_s != 0) {
        finish(performer, PERFORMER_END_THERE);
    } else {
        begin_page(performer);
    }
}

/* The compliance bytes of the page that has just begun, to the servos. */
static void send_slopes(performer_t *performer)
{
    uint8_t compliance[PAGE_JOINTS];
    performer->source->read(performer->source->context, performer->engine.player.page, PAGE_AT_COMPLIANCE, compliance,
                            sizeof compliance);
    servo_link_slopes(performer->servos, compliance);
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

static void play_tick(performer_t *performer)
{
    player_t *player = &performer->engine.player;
    const uint8_t events = player_tick(player, &performer->link);
    if ((events & PLAYER_EV_SLOPES) != 0) {
        send_slopes(performer);
    }
    if ((events & PLAYER_EV_OUTPUT) != 0) {
        servo_link_goals(performer->servos, player->goal_pos, player->joints);
    }
    if ((events & PLAYER_EV_STEP) != 0) {
        performer->page = player->page;
        tell(performer, PERFORMER_EV_STEP, player->page, player->step, player->repetition);
    }
    if ((events & PLAYER_EV_LINK) != 0) {
        tell(performer, PERFORMER_EV_LINK, player->next_page, player->link_taken, 0);
    }
    if ((events & PLAYER_EV_ENDED) != 0 || ((events & PLAYER_EV_STANDING) != 0 && performer->leaving)) {
        finish(performer, why_ended(performer));
    } else if ((events & PLAYER_EV_STANDING) != 0) {
        tell(performer, PERFORMER_EV_PAUSED, player->page, 0, 0);
    }
}

void performer_tick(performer_t *performer)
{
    if (performer->since_stop_ticks < UINT8_MAX) {
        performer->since_stop_ticks++;
    }
    if (performer->state == PERFORMER_APPROACH) {
        const bool under_way = approach_tick(&performer->engine.approach, performer->pose_pos);
        servo_link_goals(performer->servos, performer->pose_pos, performer->joints);
        if (!under_way) {
            approach_over(performer);
        }
    } else if (performer->state == PERFORMER_PLAY) {
        play_tick(performer);
    }
    servo_link_tick(performer->servos);
}

/* ---- stop, break, pause ---- */

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
        finish(performer, performer->end);
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
        stop_softly(performer);
    }
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
    if (code == LINK_CODE_STOP && player_is_paused(&performer->engine.player)) {
        player_resume(&performer->engine.player);
    }
    /* A hand that lets go before the first step: there is no page yet to leave softly. */
    if (performer->state != PERFORMER_PLAY && link_is_stopping(&performer->link)) {
        performer_break(performer);
    }
}

/* ---- torque ---- */

uint32_t performer_on(performer_t *performer, uint32_t joints)
{
    if (!performer_is_idle(performer)) {
        return 0;
    }
    joints &= performer->servos->present;
    const uint32_t on = servo_link_torque_on(performer->servos, joints);
    performer->released &= ~on;
    return on;
}

void performer_off(performer_t *performer, uint32_t joints)
{
    performer->released |= joints;
    drop(performer, joints);
    servo_link_torque_off(performer->servos, joints & performer->servos->present);
    if (!performer_is_idle(performer) && (performer->joints | performer->ready_left) == 0) {
        finish(performer, PERFORMER_END_BROKEN); /* nobody is left who moves */
    }
}
