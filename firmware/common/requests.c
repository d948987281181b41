/* SPDX-License-Identifier: MIT */
#include "requests_parts.h"

#include <stddef.h>
#include <string.h>
#include "board.h"
#include "crc16.h"
#include "performer_shape.h"
#include "ranges.h"
#include "report.h"
#include "text.h"
#include "tick.h"

#define CHUNK_BYTES 32u          /* a page is read in pieces of this size */
#define WATCH_TICKS_MIN 6u       /* 47 ms: a @now line of 31 joints takes 37 of them */

/* What goes on between two requests: @watch. */
static struct {
    uint16_t every_ticks;        /* 0: nobody watches */
    uint16_t last_tick;
} watch;

static bool for_program;

bool requests_are(const shell_args_t *args)
{
    return shell_word(args, 0)[0] == '@';
}

/* ---- answers ---- */

bool requests_of_program(void)
{
    return for_program;
}

uint8_t requests_error(uint8_t status)
{
    if (for_program) {
        TEXT(" ERR ");
        text_number(status);
        text_put(' ');
    }
    return REQUEST_SAID;
}

uint8_t requests_no_answer(uint32_t joints)
{
    if (joints == 0) {
        return REQUEST_OK;
    }
    (void)requests_error(REQUEST_ERR_SERVOS);
    TEXT("No answer from servos ");
    report_joints(joints);
    return REQUEST_SAID;
}

uint8_t requests_take_joints(const shell_args_t *args, uint8_t first, uint32_t *joints)
{
    const uint32_t present = requests_image.servos->present;
    *joints = args->count > first ? 0 : present;
    if (!ranges_take_joints(args, first, joints)) {
        return SHELL_ERR_RANGE;
    }
    return *joints == 0 ? requests_refusal(PERFORMER_ERR_NO_SERVOS) : requests_no_answer(*joints & ~present);
}

uint8_t requests_refusal(performer_status_t status)
{
    static const uint8_t numbers[] PROGMEM = {
        [PERFORMER_OK] = REQUEST_OK,
        [PERFORMER_ERR_RANGE] = REQUEST_ERR_RANGE,
        [PERFORMER_ERR_PAGE] = REQUEST_ERR_PAGE,
        [PERFORMER_ERR_EMPTY] = REQUEST_ERR_EMPTY,
        [PERFORMER_ERR_BUSY] = REQUEST_ERR_BUSY,
        [PERFORMER_ERR_NO_SERVOS] = REQUEST_ERR_SERVOS,
        [PERFORMER_ERR_RELEASED] = REQUEST_ERR_RELEASED,
        [PERFORMER_ERR_LAW] = REQUEST_ERR_IMAGE,
    };
    const performer_t *performer = requests_image.performer;
    if (status == PERFORMER_OK) {
        return REQUEST_OK;
    }
    (void)requests_error(pgm_read_byte(&numbers[status]));
    report_refusal(status, performer->fault_page, performer->fault);
    return REQUEST_SAID;
}

static void field(const char *name_P, uint16_t value)
{
    text_put(' ');
    text_P(name_P);
    text_put('=');
    text_number(value);
}

/* ---- what is there ---- */

static uint8_t do_ver(void *context, const shell_args_t *args)
{
    app_record_t record;
    (void)context;
    (void)args;
    TEXT(" image=");
    text_P(requests_image.name_P);
    if (board_record(&record)) {
        TEXT(" version=");
        report_version(&record);
        text_P(record.board == APP_RECORD_CM2 ? TEXT_P(" board=cm2") : TEXT_P(" board=cm5"));
    }
    TEXT(" protocol=1 pages=128 joints=31 line=110");
    STATIC_ASSERT(PAGE_COUNT == 128 && PAGE_JOINTS == 31, "said in the line above");
    TEXT(" can=list,page,pose,move,torque,play,pause,where,crcs,watch");
    if (requests_image.can_P != NULL) {
        text_P(requests_image.can_P);
    }
    return REQUEST_OK;
}

/* number:steps:"name", or number:!:"what is wrong". */
static void print_list_entry(uint8_t page)
{
    uint8_t header[PAGE_AT_STEPS + 1];
    const bool good = page_store_is_good(requests_image.pages, page);
    page_store_read(page, 0, header, sizeof header);
    if (good ? header[PAGE_AT_NAME] == '\0' && header[PAGE_AT_STEPS] == 0 : page_store_is_erased(page)) {
        return;
    }
    text_put(' ');
    text_number(page);
    text_put(':');
    if (!good) {
        TEXT("!:\"");
        text_P(report_page_fault_P((uint8_t)page_store_check(requests_image.pages, page)));
        text_put('"');
        return;
    }
    text_number(header[PAGE_AT_STEPS]);
    char name[PAGE_NAME_BYTES];
    page_store_name(page, name);
    TEXT(":\"");
    for (const char *c = name; *c != '\0'; c++) {
        text_put(*c == '"' ? '\'' : *c);
    }
    text_put('"');
}

/* The pages of a request: all of them when none is given, else the first and the last. false: they are not so, said. */
static bool take_pages(const shell_args_t *args, uint8_t *last)
{
    *last = args->count > 1 ? (uint8_t)args->number[1] : (uint8_t)(PAGE_COUNT - 1u);
    if (args->count == 2 || *last < args->number[0]) {
        (void)requests_error(REQUEST_ERR_RANGE);
        shell_print_range(TEXT_P("Page"), (int16_t)args->number[0], PAGE_COUNT - 1, false);
        return false;
    }
    return true;
}

static uint8_t do_list(void *context, const shell_args_t *args)
{
    uint8_t last;
    (void)context;
    if (!take_pages(args, &last)) {
        return REQUEST_SAID;
    }
    for (uint8_t page = (uint8_t)args->number[0]; page <= last; page++) {
        print_list_entry(page);
        requests_image.serve(); /* pages without an entry take up to 2 ms each */
    }
    return REQUEST_OK;
}

/* The bytes of a page in flash, as they are, into their CRC; printed too when asked for. */
static uint16_t page_crc(uint8_t page, bool print)
{
    uint16_t crc = CRC16_START;
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset = (uint16_t)(offset + CHUNK_BYTES)) {
        uint8_t bytes[CHUNK_BYTES];
        page_store_read(page, offset, bytes, sizeof bytes);
        crc = crc16_bytes(crc, bytes, sizeof bytes);
        for (uint8_t i = 0; print && i < sizeof bytes; i++) {
            text_hex(bytes[i], 2);
        }
    }
    return crc;
}

static uint8_t do_page(void *context, const shell_args_t *args)
{
    const uint8_t page = (uint8_t)args->number[0];
    (void)context;
    text_put(' ');
    text_number(page);
    text_put(' ');
    const uint16_t crc = page_crc(page, true);
    text_put(' ');
    text_hex(crc, 4);
    return REQUEST_OK;
}

/* Four digits a page, without a blank between them: 128 pages are 512 characters. */
static uint8_t do_crcs(void *context, const shell_args_t *args)
{
    uint8_t last;
    (void)context;
    if (!take_pages(args, &last)) {
        return REQUEST_SAID;
    }
    text_put(' ');
    for (uint8_t page = (uint8_t)args->number[0]; page <= last; page++) {
        text_hex(page_crc(page, false), 4);
        requests_image.serve();
    }
    return REQUEST_OK;
}

/* ---- what it does ---- */

/* id:position:torque, position "?" when the servo does not answer. */
static uint8_t do_pose(void *context, const shell_args_t *args)
{
    const servo_link_t *servos = requests_image.servos;
    (void)context;
    (void)args;
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
        [PERFORMER_IDLE] = idle, [PERFORMER_READY] = ready, [PERFORMER_APPROACH] = approach,
        [PERFORMER_STOOD] = paused, [PERFORMER_PLAY] = playing,
    };
    text_P(performer_is_paused(performer) ? paused : (const char *)pgm_read_ptr(&names[performer->state]));
}

static uint8_t do_where(void *context, const shell_args_t *args)
{
    const performer_t *performer = requests_image.performer;
    const bool plays = performer->state == PERFORMER_PLAY;
    (void)context;
    (void)args;
    TEXT(" state=");
    print_state_name(performer);
    field(TEXT_P("page"), performer_is_idle(performer) ? 0 : performer->page);
    field(TEXT_P("step"), plays ? performer->engine.player.step : 0);
    field(TEXT_P("repetition"), plays ? performer->engine.player.repetition : 0);
    field(TEXT_P("code"), plays ? performer->link.code : 0);
    field(TEXT_P("dv"), requests_image.servos->voltage_dv);
    field(TEXT_P("missed"), tick_missed());
    TEXT(" faulty=");
    text_mask(performer->faulty);
    if (requests_image.where != NULL) {
        requests_image.where();
    }
    return REQUEST_OK;
}

/* Into the boot loader's hands: it listens for '#' for 60 ms before it starts an image again. */
static uint8_t do_reset(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    requests_image.restart();
    return REQUEST_OK;   /* never reached */
}

/* ---- @watch ---- */

static uint8_t do_watch(void *context, const shell_args_t *args)
{
    const uint16_t ticks = (uint16_t)((uint32_t)args->number[0] * TICK_HZ / 1000u);
    (void)context;
    watch.every_ticks = ticks != 0 && ticks < WATCH_TICKS_MIN ? WATCH_TICKS_MIN : ticks;
    watch.last_tick = tick_now16();
    return REQUEST_OK;
}

void requests_end_watch(void)
{
    watch.every_ticks = 0;
}

bool requests_now_is_due(void)
{
    return watch.every_ticks != 0 && (uint16_t)(tick_now16() - watch.last_tick) >= watch.every_ticks;
}

/* Somebody tells this joint where to be. */
static bool is_told(const performer_t *performer, uint8_t id)
{
    const uint32_t of_play = performer->state > PERFORMER_READY ? performer->joints : 0;
    return ((of_play | performer_layers_joints(performer)) & servo_link_bit(id)) != 0;
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
    watch.last_tick = tick_now16();
    TEXT("@now ");
    text_number(performer_is_idle(performer) ? 0 : performer->page);
    text_put(' ');
    text_number(performer->state == PERFORMER_PLAY ? performer->engine.player.step : 0);
    text_put(' ');
    text_mask(servos->present);
    text_put(' ');
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if (servo_link_has(&servos->present, id)) {
            const uint16_t present_pos = servos->present_pos[id];
            print_pos(is_told(performer, id), performer->goal_pos[id]);
            print_pos(!servo_link_has(&servos->silent, id) && present_pos != SERVO_LINK_NO_POSE, present_pos);
        }
    }
    text_line_end();
}

/* ---- dispatch ---- */

TEXT_NAMED(word_ver, "ver  ");
TEXT_NAMED(word_list, "list  ");
TEXT_NAMED(word_page, "page  ");
TEXT_NAMED(word_crcs, "crcs  ");
TEXT_NAMED(word_pose, "pose  ");
TEXT_NAMED(word_watch, "watch  ");
TEXT_NAMED(word_move, "move  ");
TEXT_NAMED(word_torque, "torque  ");
TEXT_NAMED(word_where, "where  ");
TEXT_NAMED(word_reset, "reset  ");

static const shell_command_t table[] PROGMEM = {
    {word_ver, do_ver, SHELL_ARGS(0, 0), 0},
    {word_list, do_list, SHELL_ARGS(0, 2), SHELL_BOTH(RANGE_PAGE, RANGE_PAGE)},
    {word_page, do_page, SHELL_ARGS(1, 1), RANGE_PAGE},
    {word_crcs, do_crcs, SHELL_ARGS(0, 2), SHELL_BOTH(RANGE_PAGE, RANGE_PAGE)},
    {word_pose, do_pose, SHELL_ARGS(0, 0), 0},
    {word_watch, do_watch, SHELL_ARGS(1, 1), RANGE_PERIOD_MS},
    {word_move, request_move, SHELL_ARGS(3, 3), SHELL_BOTH(RANGE_DEG_S, RANGE_ID)},
    {word_torque, request_torque, SHELL_ARGS(1, SHELL_ANY_ARGS), 0},
    {word_where, do_where, SHELL_ARGS(0, 0), 0},
    {word_reset, do_reset, SHELL_ARGS(0, 0) | SHELL_STILL, 0},
};

/* The errors that have one sentence, by number. */
static void print_sentence(uint8_t status)
{
    TEXT_NAMED(no_word, "Unknown word");
    TEXT_NAMED(count, "Too few or too many words");
    TEXT_NAMED(busy, "Busy: stop what is playing first");
    TEXT_NAMED(crc, "The CRC does not fit the page in RAM");
    TEXT_NAMED(image, "Not in this image");
    TEXT_NAMED(save, "The page could not be saved");
    TEXT_NAMED(unsaved, "The open page has edits that are not saved");
    static const char *const sentences[] PROGMEM = {
        [REQUEST_ERR_WORD] = no_word, [REQUEST_ERR_COUNT] = count, [REQUEST_ERR_BUSY] = busy,
        [REQUEST_ERR_CRC] = crc, [REQUEST_ERR_IMAGE] = image,
        [REQUEST_ERR_SAVE] = save, [REQUEST_ERR_UNSAVED] = unsaved,
    };
    (void)requests_error(status);
    text_P((const char *)pgm_read_ptr(&sentences[status]));
}

/* Not inlined four times. */
static NOINLINE uint8_t look_up(const shell_command_t *table_P, uint8_t count, shell_args_t *args)
{
    return shell_run(table_P, count, requests_image.context, args, !performer_is_still(requests_image.performer));
}

/* The end of an answer, by what shell_run has returned. */
static void finish(uint8_t result)
{
    switch (result) {
    case REQUEST_OK:
        TEXT(" OK");
        break;
    case REQUEST_SAID:
        break;
    case SHELL_ERR_RANGE:
        (void)requests_error(REQUEST_ERR_RANGE);
        shell_print_broken();
        break;
    case SHELL_ERR_UNKNOWN:
        print_sentence(REQUEST_ERR_WORD);
        break;
    case SHELL_ERR_COUNT:
        print_sentence(REQUEST_ERR_COUNT);
        break;
    case SHELL_ERR_MOVING:
        print_sentence(REQUEST_ERR_BUSY);
        break;
    default:
        print_sentence(result);
        break;
    }
}

void requests_run(shell_args_t *args)
{
    for_program = true;
    text_string(shell_word(args, 0));
    args->words++; /* behind the '@' */
    uint8_t result = look_up(table, ARRAY_COUNT(table), args);
    if (result == SHELL_ERR_UNKNOWN) {
        result = look_up(requests_image.own_P, requests_image.own_count, args);
    }
    finish(result);
    text_line_end();
}

void requests_run_typed(shell_args_t *args, const shell_command_t *typed_P, uint8_t typed_count)
{
    for_program = false;
    uint8_t result = look_up(requests_image.own_P, requests_image.own_count, args);
    if (result == SHELL_ERR_UNKNOWN) {
        result = look_up(typed_P, typed_count, args);
    }
    finish(result);
    if (result == SHELL_ERR_UNKNOWN || result == SHELL_ERR_COUNT) {
        TEXT(": try help");
    }
    text_line_end();
}
