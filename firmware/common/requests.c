/* SPDX-License-Identifier: MIT
 * requests.c - the requests of both images that report the robot's state or move it, and the dispatch of lines to requests.
 * An answer has ` field=...` pieces and an end, OK or ERR, which requests_line prints. A request that fails prints nothing
 * before its error. */
#include "requests.h"

#include <stddef.h>
#include "board.h"
#include "channel.h"
#include "performer_shape.h"
#include "ranges.h"
#include "report.h"
#include "text.h"
#include "tick.h"

#define WATCH_TICKS_MIN 6u   /* 47 ms; a @now line of 31 joints takes 37 ms */

static struct {
    uint16_t every_ticks;    /* 0: off */
    uint16_t last_tick;
    bool on_channel;         /* requested through the channel */
} watch;

/* ---- state ---- */

/* Prints id:position:torque for each joint; the position is "?" if unknown. */
static uint8_t do_pose(const shell_args_t *args)
{
    const servo_link_t *servos = requests_image.servos;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (!servo_link_has(&servos->present, id)) {
            continue;
        }
        text_put(' ');
        text_number(id);
        text_put(':');
        if (servo_link_has(&servos->silent, id) || servos->present_pos[id] == SERVO_LINK_NO_POSE) {
            text_put('?');
        } else {
            text_number(servos->present_pos[id]);
        }
        text_put(':');
        text_put(servo_link_has(&servos->torque, id) ? '1' : '0');
    }
    return REQUEST_OK;
}

static void print_state_name(const performer_t *performer)
{
    TEXT_NAMED(idle, "idle");
    TEXT_NAMED(ready, "ready");
    TEXT_NAMED(approach, "approach");
    TEXT_NAMED(paused, "paused");
    TEXT_NAMED(playing, "playing");
    static const char *const names[] PROGMEM = {
        [PERFORMER_IDLE] = idle, [PERFORMER_READY] = ready, [PERFORMER_APPROACH] = approach, [PERFORMER_PLAY] = playing,
    };
    text_P(performer_is_paused(performer) ? paused : (const char *)pgm_read_ptr(&names[performer->state]));
}

static uint8_t do_where(const shell_args_t *args)
{
    const performer_t *performer = requests_image.performer;
    const bool plays = performer->state == PERFORMER_PLAY;
    TEXT(" state=");
    print_state_name(performer);
    text_P_number(TEXT_P(" page="), performer_page(performer));
    text_P_number(TEXT_P(" step="), plays ? performer->player.now.step : 0);
    text_P_number(TEXT_P(" repetition="), plays ? performer->player.repetition : 0);
    text_P_number(TEXT_P(" code="), plays ? performer->link.code : 0);
    text_P_number(TEXT_P(" dv="), requests_image.servos->voltage_dv);
    text_P_number(TEXT_P(" missed="), tick_missed());
    TEXT(" faulty=");
    text_mask(performer->faulty);
    if (requests_image.where != NULL) {
        requests_image.where();
    }
    return REQUEST_OK;
}

/* ---- @watch ---- */

static uint8_t do_watch(const shell_args_t *args)
{
    const uint16_t ticks = (uint16_t)((uint32_t)args->number[0] * TICK_HZ / 1000u);
    watch.every_ticks = args->number[0] != 0 && ticks < WATCH_TICKS_MIN ? WATCH_TICKS_MIN : ticks;
    watch.last_tick = tick_now16();
    watch.on_channel = channel_is_printing();
    return REQUEST_OK;
}

void requests_end_watch(void)
{
    if (!watch.on_channel) {
        watch.every_ticks = 0;
    }
}

bool requests_now_is_on_channel(void)
{
    return watch.on_channel;
}

bool requests_now_is_due(void)
{
    return watch.every_ticks != 0 && (uint16_t)(tick_now16() - watch.last_tick) >= watch.every_ticks;
}

/* The joints that a play, a move or a layer gives goals. */
static uint32_t joints_with_goals(const performer_t *performer)
{
    const uint32_t of_play = performer->state > PERFORMER_READY ? performer->joints : 0;
    return of_play | performer_layers_joints(performer);
}

static void print_pos(bool known, uint16_t pos)
{
    if (known) {
        text_hex(pos, 3);
    } else {
        TEXT("---");
    }
}

void requests_print_now(void)
{
    const performer_t *performer = requests_image.performer;
    const servo_link_t *servos = requests_image.servos;
    const uint32_t with_goals = joints_with_goals(performer);
    watch.last_tick = tick_now16();
    if (watch.on_channel) {
        channel_print_begin();
    }
    text_P_number(TEXT_P("@now "), performer_page(performer));
    text_put(' ');
    text_number(performer->state == PERFORMER_PLAY ? performer->player.now.step : 0);
    text_put(' ');
    text_mask(servos->present);
    text_put(' ');
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (servo_link_has(&servos->present, id)) {
            const uint16_t present_pos = servos->present_pos[id];
            print_pos(servo_link_has(&with_goals, id), servo_link_limited(performer->goal_pos[id]));
            print_pos(!servo_link_has(&servos->silent, id) && present_pos != SERVO_LINK_NO_POSE, present_pos);
        }
    }
    text_line_end();
    channel_print_end();
}

/* ---- motion ---- */

/* Parses three digits per joint, from joint `id` on, into to_pos; --- skips a joint. Returns the joints read; 0: error. */
static uint32_t parse_pose(uint8_t id, const char *digits, uint16_t to_pos[PAGE_JOINTS])
{
    uint32_t joints = 0;
    for (; *digits != '\0'; digits += 3, id++) {
        uint16_t pos;
        if (digits[0] == '-' && digits[1] == '-' && digits[2] == '-') {
            continue;
        }
        if (id >= PAGE_JOINTS || !shell_hex(digits, 3, &pos) || pos > PAGE_POS_MAX) {
            return 0;
        }
        to_pos[id] = pos;
        servo_link_put(&joints, id, true);
    }
    return joints;
}

static uint8_t do_move(const shell_args_t *args)
{
    uint16_t to_pos[PAGE_JOINTS] = {0};
    const uint32_t joints = parse_pose((uint8_t)args->number[1], shell_word(args, 3), to_pos);
    if (joints == 0) {
        return requests_refuse(REQUEST_ERR_RANGE, TEXT_P("Positions are 000..3FF or ---, up to ID 30"));
    }
    return requests_refusal(performer_move(requests_image.performer, to_pos, joints, args->number[0]));
}

uint32_t requests_switch_torque(uint32_t joints, bool on)
{
    uint32_t done = 0;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (servo_link_has(&joints, id)) {
            const uint32_t joint = servo_link_bit(id);
            done |= on ? performer_on(requests_image.performer, joint) : performer_off(requests_image.performer, joint);
            requests_image.serve();
        }
    }
    return done;
}

static uint8_t switch_named(const shell_args_t *args, uint8_t first, bool on)
{
    uint32_t joints;
    const uint8_t status = requests_take_joints(args, first, &joints);
    if (status != REQUEST_OK) {
        return status;
    }
    if (on && !performer_is_idle(requests_image.performer)) {   /* not in the table, because off is always allowed */
        return SHELL_ERR_MOVING;
    }
    joints &= ~requests_switch_torque(joints, on);
    const char *why_P = report_disobedience_P(requests_image.servos, &joints);
    return requests_servos(joints, why_P);
}

static uint8_t do_torque(const shell_args_t *args)
{
    const bool on = shell_word_is(args, 1, PSTR("on"));
    if (!on && !shell_word_is(args, 1, PSTR("off"))) {
        return requests_refuse(REQUEST_ERR_RANGE, TEXT_P("Say on or off"));
    }
    return switch_named(args, 2, on);
}

uint8_t request_on(const shell_args_t *args)
{
    return switch_named(args, 1, true);
}

uint8_t request_off(const shell_args_t *args)
{
    return switch_named(args, 1, false);
}

uint8_t request_play(const shell_args_t *args)
{
    return requests_refusal(performer_start(requests_image.performer, (uint8_t)args->number[0], (uint8_t)args->number[1]));
}

/* These four answer OK even if there is nothing to do. A program can ask @where. */
uint8_t request_stop(const shell_args_t *args)
{
    performer_stop(requests_image.performer);
    return REQUEST_OK;
}

uint8_t request_break(const shell_args_t *args)
{
    performer_break(requests_image.performer);
    return REQUEST_OK;
}

uint8_t request_pause(const shell_args_t *args)
{
    (void)performer_pause(requests_image.performer);
    return REQUEST_OK;
}

uint8_t request_resume(const shell_args_t *args)
{
    (void)performer_resume(requests_image.performer);
    return REQUEST_OK;
}

/* ---- the image ---- */

static uint8_t do_ver(const shell_args_t *args)
{
    app_record_t record;
    TEXT(" image=");
    text_P(requests_image.name_P);
    if (board_record(&record)) {
        TEXT(" version=");
        report_version(&record);
        TEXT(" board=");
        text_P(report_board_P(&record));
    }
    STATIC_ASSERT(PAGE_JOINTS == 31, "the number in the line after the next");
    text_P_number(TEXT_P(" protocol=1 pages="), PAGE_COUNT);
    TEXT(" joints=31 line=110"
         " can=list,page,pose,move,torque,play,pause,where,crcs,watch,dense");
    if (requests_image.can_P != NULL) {
        text_P(requests_image.can_P);
    }
    return REQUEST_OK;
}

/* A program sends '#' next: the boot loader listens for 60 ms before it starts an image again. */
static uint8_t do_reset(const shell_args_t *args)
{
    requests_image.restart();
    return REQUEST_OK;   /* never reached */
}

/* ---- dispatch ---- */

TEXT_NAMED(word_ver, "ver  ");
TEXT_NAMED(word_list, "list  ");
TEXT_NAMED(word_page, "page  ");
TEXT_NAMED(word_dense, "dense  ");
TEXT_NAMED(word_crcs, "crcs  ");
TEXT_NAMED(word_pose, "pose  ");
TEXT_NAMED(word_watch, "watch  ");
TEXT_NAMED(word_move, "move  ");
TEXT_NAMED(word_torque, "torque  ");
TEXT_NAMED(word_where, "where  ");
TEXT_NAMED(word_reset, "reset  ");

static const shell_command_t table[] PROGMEM = {
    {word_ver, do_ver, SHELL_ARGS(0, 0), 0},
    {word_list, request_list, SHELL_ARGS(0, 2), SHELL_BOTH(RANGE_PAGE, RANGE_PAGE)},
    {word_page, request_page, SHELL_ARGS(1, 1), RANGE_PAGE},
    {word_dense, request_dense, SHELL_ARGS(1, 1), RANGE_PAGE},
    {word_crcs, request_crcs, SHELL_ARGS(0, 2), SHELL_BOTH(RANGE_PAGE, RANGE_PAGE)},
    {word_pose, do_pose, SHELL_ARGS(0, 0), 0},
    {word_watch, do_watch, SHELL_ARGS(1, 1), RANGE_PERIOD_MS},
    {word_move, do_move, SHELL_ARGS(3, 3), SHELL_BOTH(RANGE_DEG_S, RANGE_ID)},
    {word_torque, do_torque, SHELL_ARGS(1, SHELL_ANY_ARGS), 0},
    {word_where, do_where, SHELL_ARGS(0, 0), 0},
    {word_reset, do_reset, SHELL_ARGS(0, 0) | SHELL_STILL, 0},
};

static uint8_t look_up(const shell_command_t *table_P, uint8_t count, shell_args_t *args)
{
    return shell_run(table_P, count, args, !performer_is_still(requests_image.performer));
}

/* Prints the end of an answer. result: what shell_run returned. */
static void finish(uint8_t result)
{
    switch (result) {
    case REQUEST_OK:
        TEXT(" OK");
        break;
    case SHELL_ERR_UNKNOWN:
        (void)requests_refuse(REQUEST_ERR_WORD, TEXT_P("Unknown word"));
        break;
    case SHELL_ERR_COUNT:
        (void)requests_refuse(REQUEST_ERR_COUNT, TEXT_P("Too few or too many words"));
        break;
    case SHELL_ERR_RANGE:
        (void)requests_error(REQUEST_ERR_RANGE);
        shell_print_range_error();
        break;
    case SHELL_ERR_MOVING:
        (void)requests_refusal(PERFORMER_ERR_BUSY);
        break;
    case SHELL_ERR_LOSSY:
    case SHELL_ERR_LONG:
        (void)requests_error(REQUEST_ERR_LINE);
        shell_print_refusal(result);
        break;
    default:
        break;   /* SHELL_ERR_REPORTED */
    }
}

void requests_line(char *line, uint8_t fault)
{
    shell_args_t args;
    uint8_t result = fault;
    shell_words(line, false, &args);
    requests_set_program(true);
    text_string(shell_word(&args, 0));
    args.words++; /* skips the '@' */
    if (result == SHELL_OK) {
        result = look_up(table, ARRAY_COUNT(table), &args);
    }
    if (result == SHELL_ERR_UNKNOWN) {
        result = look_up(requests_image.own->rows_P, requests_image.own->count, &args);
    }
    finish(result);
    text_line_end();
}

void requests_answer_channel(void)
{
    uint8_t fault;
    char *line = channel_take(&fault);
    channel_print_begin();
    requests_line(line, fault);
    channel_print_end();
}

bool requests_run_typed(shell_args_t *args, const shell_command_t *typed_P, uint8_t typed_count)
{
    requests_set_program(false);
    uint8_t result = look_up(requests_image.own->rows_P, requests_image.own->count, args);
    if (result == SHELL_ERR_UNKNOWN) {
        result = look_up(typed_P, typed_count, args);
    }
    finish(result);
    if (result == SHELL_ERR_UNKNOWN || result == SHELL_ERR_COUNT) {
        TEXT(": try help");
    }
    text_line_end();
    return result == REQUEST_OK;
}
