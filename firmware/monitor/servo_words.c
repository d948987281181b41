/* SPDX-License-Identifier: MIT */
#include "servo_words.h"

#include <stddef.h>
#include <string.h>
#include "bus.h"
#include "bus_call.h"
#include "dxl.h"
#include "packets.h"
#include "pgm.h"
#include "ranges_own.h"
#include "search.h"
#include "text.h"

enum { TABLE_BYTES = 50, DUMP_ROW = 10, PARAMS_MAX = 32 };

static uint8_t current;

/* ---- packets ---- */

static uint8_t send(uint8_t instruction, uint8_t count)
{
    (void)packets_exchange(current, instruction, count);
    return SHELL_OK;
}

/* Takes all words as parameters. SHELL_ERR_COUNT: too many; SHELL_ERR_RANGE: one is not a byte. */
static uint8_t take_bytes(const shell_args_t *args)
{
    if (args->count > 1 + PARAMS_MAX) {
        return SHELL_ERR_COUNT;
    }
    for (uint8_t i = 1; i < args->count; i++) {
        uint16_t byte;
        if (!shell_take(args, i, RANGE_BYTE, &byte)) {
            return SHELL_ERR_RANGE;
        }
        packets_params()[i - 1] = (uint8_t)byte;
    }
    return SHELL_OK;
}

static uint8_t send_bytes(const shell_args_t *args, uint8_t instruction)
{
    const uint8_t result = take_bytes(args);
    return result == SHELL_OK ? send(instruction, (uint8_t)(args->count - 1u)) : result;
}

/* Writes the line's number to one address. */
static bool write_number(const shell_args_t *args, uint8_t address)
{
    packets_params()[0] = address;
    packets_params()[1] = (uint8_t)args->number[0];
    return packets_exchange(current, DXL_WRITE, 2);
}

/* Refuses words that would misconfigure all servos at once. */
static bool is_one_servo(void)
{
    if (current == DXL_BROADCAST) {
        (void)packets_say(TEXT_P("One servo only: CID first"));
    }
    return current != DXL_BROADCAST;
}

/* ---- words ---- */

void servo_words_init(void)
{
    current = 1;
}

uint8_t servo_words_current(void)
{
    return current;
}

WORD(servo_words_cid)
{
    current = (uint8_t)args->number[0];
    return SHELL_OK;
}

WORD(servo_words_ping)
{
    (void)packets_exchange(args->count > 1 ? (uint8_t)args->number[0] : current, DXL_PING, 0);
    return SHELL_OK;
}

WORD(servo_words_read)
{
    packets_params()[0] = (uint8_t)args->number[0];
    packets_params()[1] = args->count > 2 ? (uint8_t)args->number[1] : 1u;
    return is_one_servo() ? send(DXL_READ, 2) : SHELL_ERR_REPORTED;
}

WORD(servo_words_write)
{
    return send_bytes(args, DXL_WRITE);
}

WORD(servo_words_reg_write)
{
    return send_bytes(args, DXL_REG_WRITE);
}

WORD(servo_words_action)
{
    return send(DXL_ACTION, 0);
}

WORD(servo_words_go)
{
    packets_params()[0] = DXL_AT_GOAL;
    memcpy(packets_params() + 1, args->number, sizeof args->number);
    return send(DXL_WRITE, args->count > 2 ? 5 : 3);
}

WORD(servo_words_led)
{
    (void)write_number(args, DXL_AT_LED);
    return SHELL_OK;
}

/* An ID must be free: two servos with one ID can only be told apart by unplugging one. */
static bool is_taken(uint8_t id, uint8_t rate)
{
    const bool taken = search_is_there(id, rate);
    if (taken) {
        (void)packets_say(rate == BUS_RATE_1M ? TEXT_P("That ID is taken")
                                              : TEXT_P("That ID is taken at 57142 bps: FAST first"));
    }
    return taken;
}

/* After an exchange without a good answer: the servo may have obeyed all the same. The new ID at the new rate was free
 * before, so who answers there now is this servo. */
static bool has_moved(uint8_t id, uint8_t rate)
{
    const bool moved = search_is_there(id, rate);
    if (moved) {
        text_P_number(TEXT_P("It has obeyed: it answers now as ID "), id);
        (void)packets_say(rate == BUS_RATE_1M ? TEXT_P(" at 1 Mbps") : TEXT_P(" at 57142 bps"));
    }
    return moved;
}

WORD(servo_words_baud)
{
    const uint8_t rate = (uint8_t)args->number[0];
    if (!is_one_servo()) {
        return SHELL_ERR_REPORTED;
    }
    if (rate != BUS_RATE_1M && rate != BUS_RATE_57142) {
        return packets_say(TEXT_P("BAUD 1: 1 Mbps. BAUD 34 (hex 22): 57142 bps. No image speaks another rate"));
    }
    if (rate == BUS_RATE_1M) {   /* it has this rate already */
        (void)write_number(args, DXL_AT_BAUD);
    } else if (!is_taken(current, rate) && !write_number(args, DXL_AT_BAUD)) {
        (void)has_moved(current, rate);
    }
    return SHELL_OK;
}

WORD(servo_words_id)
{
    uint8_t id = (uint8_t)args->number[0];
    if (!is_one_servo() || is_taken(id, BUS_RATE_1M) || is_taken(id, BUS_RATE_57142)) {
        return SHELL_ERR_REPORTED;
    }
    if (write_number(args, DXL_AT_ID) || has_moved(id, BUS_RATE_1M)) {
        current = id;
    }
    return SHELL_OK;
}

WORD(servo_words_reset)
{
    if (!is_one_servo()) {
        return SHELL_ERR_REPORTED;
    }
    if (!shell_word_is(args, 1, PSTR("yes"))) {
        return packets_say(TEXT_P("RESET YES: factory values, ID 1"));
    }
    if ((current != 1 && is_taken(1, BUS_RATE_1M)) || is_taken(1, BUS_RATE_57142)) {
        return SHELL_ERR_REPORTED;
    }
    /* The factory rate of some servos is 57,142 bps. */
    if (packets_exchange(current, DXL_RESET, 0) || (current != 1 && has_moved(1, BUS_RATE_1M)) ||
        has_moved(1, BUS_RATE_57142)) {
        current = 1;
    }
    return SHELL_OK;
}

/* swr address count, then for each servo its ID and `count` bytes. */
WORD(servo_words_sync_write)
{
    const uint8_t result = take_bytes(args), count = (uint8_t)(args->count - 1u), each = packets_params()[1];
    if (result != SHELL_OK) {
        return result;
    }
    if (count < 4 || each == 0 || (uint16_t)(count - 2) % (uint16_t)(each + 1) != 0) {
        return packets_say(TEXT_P("SWR address count id byte .. id byte .."));
    }
    (void)packets_exchange(DXL_BROADCAST, DXL_SYNC_WRITE, count);
    return SHELL_OK;
}

WORD(servo_words_dump)
{
    uint8_t row[DUMP_ROW];
    for (uint8_t at = 0; at < TABLE_BYTES && is_one_servo(); at += DUMP_ROW) {
        bus_status_t status = bus_call_read(current, at, row, DUMP_ROW, NULL);
        if (status != BUS_OK) {
            return packets_say_status(status);
        }
        text_padded(at, 3, '0');
        packets_print_bytes(TEXT_P(":"), row, DUMP_ROW);
        text_line_end();
    }
    return SHELL_OK;
}
