/* SPDX-License-Identifier: MIT */
#include "requests_parts.h"

#include <stddef.h>
#include "board.h"
#include "ranges.h"
#include "report.h"
#include "text.h"

bool requests_is_request(const shell_args_t *args)
{
    return shell_word(args, 0)[0] == '@';
}

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
    STATIC_ASSERT(PAGE_COUNT == 128 && PAGE_JOINTS == 31, "the numbers in the next line");
    TEXT(" protocol=1 pages=128 joints=31 line=110"
         " can=list,page,pose,move,torque,play,pause,where,crcs,watch,dense");
    if (requests_image.can_P != NULL) {
        text_P(requests_image.can_P);
    }
    return REQUEST_OK;
}

/* A program follows it with '#': the boot loader listens for 60 ms before it starts an image again. */
static uint8_t do_reset(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
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
    {word_pose, request_pose, SHELL_ARGS(0, 0), 0},
    {word_watch, request_watch, SHELL_ARGS(1, 1), RANGE_PERIOD_MS},
    {word_move, request_move, SHELL_ARGS(3, 3), SHELL_BOTH(RANGE_DEG_S, RANGE_ID)},
    {word_torque, request_torque, SHELL_ARGS(1, SHELL_ANY_ARGS), 0},
    {word_where, request_where, SHELL_ARGS(0, 0), 0},
    {word_reset, do_reset, SHELL_ARGS(0, 0) | SHELL_STILL, 0},
};

/* NOINLINE: it would be copied to four places. */
static NOINLINE uint8_t look_up(const shell_command_t *table_P, uint8_t count, shell_args_t *args)
{
    return shell_run(table_P, count, requests_image.context, args, !performer_is_still(requests_image.performer));
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
    default:
        break;   /* SHELL_ERR_REPORTED */
    }
}

void requests_run(shell_args_t *args)
{
    requests_set_program(true);
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
    requests_set_program(false);
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
