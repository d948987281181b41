/* SPDX-License-Identifier: MIT
 * monitor.c - the words of the servo bus monitor (editor-original.md section 11). Most send one packet to the current servo
 * (CID) and show it and its answer, byte by byte. */
#include "monitor.h"

#include <stddef.h>
#include <string.h>
#include "bus.h"
#include "bus_call.h"
#include "console.h"
#include "dxl.h"
#include "packets.h"
#include "pgm.h"
#include "ranges_own.h"
#include "search.h"
#include "system.h"
#include "text.h"

enum { TABLE_BYTES = 50, DUMP_ROW = 10, PARAMS_MAX = 32, SCAN_LAST = 127 };

/* The only one. */
static struct {
    uint8_t cid;    /* the current servo; 254: all */
    bool hex;       /* numbers are hexadecimal */
} monitor;

/* ---- packets ---- */

static uint8_t send(uint8_t instruction, uint8_t count)
{
    (void)packets_exchange(monitor.cid, instruction, count);
    return SHELL_OK;
}

/* Takes all words as parameters. Returns their number; 0: one of them is no byte (SHELL_ERR_RANGE). */
static uint8_t take_bytes(const shell_args_t *args)
{
    uint8_t count = (uint8_t)(args->count - 1u);
    if (count > PARAMS_MAX) {
        return 0;
    }
    for (uint8_t i = 0; i < count; i++) {
        uint16_t byte;
        if (!shell_take(args, (uint8_t)(i + 1u), RANGE_BYTE, &byte)) {
            return 0;
        }
        packets_params()[i] = (uint8_t)byte;
    }
    return count;
}

static uint8_t send_bytes(const shell_args_t *args, uint8_t instruction)
{
    uint8_t count = take_bytes(args);
    return count == 0 ? (uint8_t)SHELL_ERR_RANGE : send(instruction, count);
}

/* Writes the line's number to one address. */
static bool write_number(const shell_args_t *args, uint8_t address)
{
    packets_params()[0] = address;
    packets_params()[1] = (uint8_t)args->number[0];
    return packets_exchange(monitor.cid, DXL_WRITE, 2);
}

/* Refuses words that would ruin all servos at once. */
static bool is_one_servo(void)
{
    if (monitor.cid == DXL_BROADCAST) {
        (void)packets_say(TEXT_P("One servo only: CID first"));
    }
    return monitor.cid != DXL_BROADCAST;
}

/* ---- words ---- */

#define UNUSED __attribute__((unused))
#define WORD(name) static uint8_t name(void *context UNUSED, const shell_args_t *args UNUSED)

WORD(mon_cid)
{
    monitor.cid = (uint8_t)args->number[0];
    return SHELL_OK;
}

WORD(mon_ping)
{
    (void)packets_exchange(args->count > 1 ? (uint8_t)args->number[0] : monitor.cid, DXL_PING, 0);
    return SHELL_OK;
}

WORD(mon_read)
{
    packets_params()[0] = (uint8_t)args->number[0];
    packets_params()[1] = args->count > 2 ? (uint8_t)args->number[1] : 1u;
    return is_one_servo() ? send(DXL_READ, 2) : (uint8_t)SHELL_ERR_REPORTED;
}

WORD(mon_write)
{
    return send_bytes(args, DXL_WRITE);
}

WORD(mon_reg_write)
{
    return send_bytes(args, DXL_REG_WRITE);
}

WORD(mon_action)
{
    return send(DXL_ACTION, 0);
}

WORD(mon_go)
{
    packets_params()[0] = DXL_AT_GOAL;
    memcpy(packets_params() + 1, args->number, sizeof args->number);
    return send(DXL_WRITE, args->count > 2 ? 5 : 3);
}

WORD(mon_led)
{
    (void)write_number(args, DXL_AT_LED);
    return SHELL_OK;
}

WORD(mon_baud)
{
    if (is_one_servo()) {
        (void)write_number(args, DXL_AT_BAUD);
    }
    return SHELL_OK;
}

/* The new ID must be free: two servos with one ID can only be told apart by unplugging one. */
WORD(mon_id)
{
    uint8_t id = (uint8_t)args->number[0];
    if (!is_one_servo()) {
        return SHELL_ERR_REPORTED;
    }
    if (bus_call_ping(id, PACKETS_TRIES, NULL) == BUS_OK) {
        return packets_say(TEXT_P("That ID is taken"));
    }
    if (write_number(args, DXL_AT_ID)) {
        monitor.cid = id;
    }
    return SHELL_OK;
}

WORD(mon_reset)
{
    if (!is_one_servo()) {
        return SHELL_ERR_REPORTED;
    }
    return shell_word_is(args, 1, PSTR("yes")) ? send(DXL_RESET, 0) : packets_say(TEXT_P("RESET YES: factory values, ID 1"));
}

/* swr address count, then for each servo its ID and `count` bytes. */
WORD(mon_sync_write)
{
    uint8_t count = take_bytes(args), each = packets_params()[1];
    if (count < 4 || each == 0 || (uint16_t)(count - 2) % (uint16_t)(each + 1) != 0) {
        return packets_say(TEXT_P("SWR address count id byte .. id byte .."));
    }
    (void)packets_exchange(DXL_BROADCAST, DXL_SYNC_WRITE, count);
    return SHELL_OK;
}

/* ---- the bus ---- */

WORD(mon_scan)
{
    search_ids(args->count > 1 ? (uint8_t)args->number[0] : (uint8_t)SCAN_LAST);
    return SHELL_OK;
}

WORD(mon_search)
{
    search_rates();
    return SHELL_OK;
}

WORD(mon_fast)
{
    search_make_fast();
    return SHELL_OK;
}

WORD(mon_dump)
{
    uint8_t row[DUMP_ROW];
    for (uint8_t at = 0; at < TABLE_BYTES && is_one_servo(); at = (uint8_t)(at + DUMP_ROW)) {
        bus_status_t status = bus_call_read(monitor.cid, at, row, DUMP_ROW, NULL);
        if (status != BUS_OK) {
            return packets_say_status(status);
        }
        text_padded(at, 3, '0');
        packets_print_bytes(TEXT_P(":"), row, DUMP_ROW);
        text_line_end();
    }
    return SHELL_OK;
}

WORD(mon_hex)
{
    monitor.hex = true;
    return SHELL_OK;
}

WORD(mon_dec)
{
    monitor.hex = false;
    return SHELL_OK;
}

WORD(mon_exit)
{
    console_flush();
    system_restart();
    return SHELL_OK;   /* never reached */
}

WORD(mon_toss)
{
    static uint8_t heard[TOSS_BUFFER_BYTES];
    (void)packets_say(TEXT_P("Three ESC end it"));
    toss_run(heard);
    text_line_end();
    return SHELL_OK;
}

/* ---- the table ---- */

WORD(mon_help);

TEXT_NAMED(word_help, "help ? this list");
TEXT_NAMED(word_dump, "dump d all 50 bytes of the servo");
TEXT_NAMED(word_id, "id  n  a new ID");
TEXT_NAMED(word_cid, "cid  id  whom the words are for; 254: all");
TEXT_NAMED(word_read, "read r address [count]");
TEXT_NAMED(word_write, "write w address byte ..");
TEXT_NAMED(word_reg_wr, "reg_wr  address byte ..  waits for ACTION");
TEXT_NAMED(word_action, "action  carries out what REG_WR sent");
TEXT_NAMED(word_go, "go g position [speed]");
TEXT_NAMED(word_hex, "hex  numbers");
TEXT_NAMED(word_dec, "dec  numbers");
TEXT_NAMED(word_reset, "reset  yes  factory values");
TEXT_NAMED(word_ping, "ping  [id]");
TEXT_NAMED(word_swr, "swr  address count id byte ..  to several at once");
TEXT_NAMED(word_scan, "scan  [last id]  who is there");
TEXT_NAMED(word_led, "led  0|1");
TEXT_NAMED(word_baud, "baud  n  2,000,000 / (n + 1)");
TEXT_NAMED(word_search, "search  who is there, at both rates");
TEXT_NAMED(word_fast, "fast  moves servos at 57142 bps to 1 Mbps");
TEXT_NAMED(word_toss, "toss  packets of the PC to the servos and back");
TEXT_NAMED(word_exit, "exit  restarts the controller");

static const shell_command_t table_P[] PROGMEM = {
    { word_help, mon_help, SHELL_ARGS(0, 1), 0 },
    { word_dump, mon_dump, SHELL_ARGS(0, 1), 0 },
    { word_id, mon_id, SHELL_ARGS(1, 1), RANGE_ONE_ID },
    { word_cid, mon_cid, SHELL_ARGS(1, 1), RANGE_BUS_ID },
    { word_read, mon_read, SHELL_ARGS(1, 2), SHELL_BOTH(RANGE_ADDRESS, RANGE_COUNT) },
    { word_write, mon_write, SHELL_ARGS(2, SHELL_ANY_ARGS), 0 },
    { word_reg_wr, mon_reg_write, SHELL_ARGS(2, SHELL_ANY_ARGS), 0 },
    { word_action, mon_action, SHELL_ARGS(0, 0), 0 },
    { word_go, mon_go, SHELL_ARGS(1, 2), SHELL_BOTH(RANGE_POSITION, RANGE_MOVING_SPEED) },
    { word_hex, mon_hex, SHELL_ARGS(0, 0), 0 },
    { word_dec, mon_dec, SHELL_ARGS(0, 0), 0 },
    { word_reset, mon_reset, SHELL_ARGS(0, 1), 0 },
    { word_ping, mon_ping, SHELL_ARGS(0, 1), RANGE_BUS_ID },
    { word_swr, mon_sync_write, SHELL_ARGS(3, SHELL_ANY_ARGS), 0 },
    { word_scan, mon_scan, SHELL_ARGS(0, 1), RANGE_ONE_ID },
    { word_led, mon_led, SHELL_ARGS(1, 1), RANGE_SWITCH },
    { word_baud, mon_baud, SHELL_ARGS(1, 1), RANGE_BAUD },
    { word_search, mon_search, SHELL_ARGS(0, 0), 0 },
    { word_fast, mon_fast, SHELL_ARGS(0, 0), 0 },
    { word_toss, mon_toss, SHELL_ARGS(0, 0), 0 },
    { word_exit, mon_exit, SHELL_ARGS(0, 0), 0 },
};

WORD(mon_help)
{
    for (uint8_t i = 0; i < ARRAY_COUNT(table_P); i++) {
        shell_print_help(&table_P[i]);
    }
    return SHELL_OK;
}

/* ---- lines ---- */

void monitor_init(void)
{
    monitor.cid = 1;
}

void monitor_prompt(void)
{
    TEXT(" [CID:");
    text_padded(monitor.cid, 3, '0');
    TEXT("(0X");
    text_hex(monitor.cid, 2);
    TEXT(")] ");
}

void monitor_line(shell_t *shell)
{
    shell_args_t args;
    shell_split(shell, monitor.hex, &args);
    switch (shell_run(table_P, ARRAY_COUNT(table_P), NULL, &args, false)) {
    case SHELL_ERR_UNKNOWN:
        (void)packets_say(TEXT_P(" Bad Command: HELP lists all"));
        break;
    case SHELL_ERR_COUNT:
        (void)packets_say(TEXT_P(" Invalid Parameter"));
        break;
    case SHELL_ERR_RANGE:
        text_put(' ');
        shell_print_range_error();
        text_line_end();
        break;
    default:
        break;
    }
}
