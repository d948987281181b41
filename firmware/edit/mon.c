/* SPDX-License-Identifier: MIT
 * mon.c - MON, the line monitor of the servo bus: its words, their table, packets in and out as they are.
 * Plain lines; the screen is hidden meanwhile, the page and its edits stay as they are. TOSS is in mon_toss.c. */
#include "bus.h"
#include "bus_call.h"
#include "commands.h"
#include "dxl.h"
#include "dxl_packet.h"
#include "mon.h"
#include "pgm.h"
#include "system.h"
#include "text.h"

enum { TABLE_BYTES = 50, DUMP_ROW = 10, PARAMS_MAX = 32, TRIES = 2, ID_MAX = 253, SCAN_LAST = 127, BAD = -1 };

static uint8_t say(const char *text_in_flash)
{
    text_P(text_in_flash);
    text_line_end();
    return SHELL_ERR_SAID;
}

/* ---- packets ---- */

static void print_bytes(const char *before_P, const uint8_t *bytes, uint8_t count)
{
    text_P(before_P);
    while (count-- > 0) {
        text_put(' ');
        text_hex(*bytes++, 2);
    }
}

static const char *status_text_P(bus_status_t status)
{
    switch (status) {
    case BUS_ERR_TIMEOUT: return TEXT_P("[Err:RxD Timeout]");
    case BUS_ERR_CHECKSUM: return TEXT_P("[Err:Wrong CheckSum]");
    case BUS_ERR_FRAMING: return TEXT_P("[Err:Wrong Header]");
    case BUS_ERR_WRONG_ID: return TEXT_P("[Err:TxID != RxID]");
    default: return TEXT_P("[Err:Wrong Length]");
    }
}

/* Parameters are put where bus_call will want them: into the packet. */
static uint8_t *params(void)
{
    return bus_packet() + DXL_PARAMS_AT;
}

/* Sends `count` parameters, shows both packets, and returns whether it was answered. */
static bool transact(uint8_t id, uint8_t instruction, uint8_t count)
{
    bus_answer_t answer = { 0, 0, 0, NULL };
    bool silent = id == DXL_BROADCAST && instruction != DXL_PING;
    uint8_t expected = silent ? BUS_NO_ANSWER : instruction == DXL_READ ? params()[1] : 0;
    bus_status_t status = bus_call(id, instruction, params(), count, expected, silent ? 1 : TRIES, &answer);
    print_bytes(TEXT_P("->[Dynamixel]:"), bus_packet(), (uint8_t)(bus_packet()[3] + 4u));
    text_line_end();
    if (silent) {
        return false;
    }
    if (status == BUS_OK) {
        print_bytes(TEXT_P("<-[Dynamixel]: ID"), &answer.id, 1);
        print_bytes(TEXT_P(" error"), &answer.error, 1);
        print_bytes(TEXT_P(" :"), answer.params, answer.count);
        text_line_end();
    } else {
        (void)say(status_text_P(status));
    }
    return status == BUS_OK;
}

/* ---- numbers ---- */

/* Word `index` as a number from 0 to max; BAD: it is none, and that was said. */
static int16_t number_of(const shell_args_t *args, uint8_t index, const char *what_P, uint16_t max)
{
    uint16_t number;
    if (shell_number(args, index, what_P, 0, max, &number)) {
        return (int16_t)number;
    }
    text_line_end();
    return BAD;
}

static int16_t id_of(const shell_args_t *args, uint8_t max)
{
    return number_of(args, 1, TEXT_P("ID"), max);
}

/* All words as parameters; returns how many, 0: something was wrong and was said. */
static uint8_t bytes_of(const shell_args_t *args)
{
    uint8_t *to = params();
    for (uint8_t index = 1; index < args->count; index++) {
        if (index > PARAMS_MAX) {
            (void)say(TEXT_P(" Invalid Parameter"));
            return 0;
        }
        int16_t byte = number_of(args, index, TEXT_P("Byte"), UINT8_MAX);
        if (byte == BAD) {
            return 0;
        }
        *to++ = (uint8_t)byte;
    }
    return (uint8_t)(args->count - 1u);
}

static bool is_one_servo(void)
{
    if (the_editor.cid == DXL_BROADCAST) {
        (void)say(TEXT_P("One servo only: CID first"));
    }
    return the_editor.cid != DXL_BROADCAST;
}

/* ---- words ---- */

#define UNUSED __attribute__((unused))
#define WORD(name) static uint8_t name(void *context UNUSED, const shell_args_t *args UNUSED)

/* The words from 1 on, address first, as parameters. */
static uint8_t send_words(const shell_args_t *args, uint8_t instruction)
{
    uint8_t count = bytes_of(args);
    if (count != 0) {
        (void)transact(the_editor.cid, instruction, count);
    }
    return SHELL_OK;
}

static bool send_value(uint8_t address, int16_t value)
{
    params()[0] = address;
    params()[1] = (uint8_t)value;
    return value != BAD && transact(the_editor.cid, DXL_WRITE, 2);
}

static int16_t value_of(const shell_args_t *args, uint8_t max)
{
    return number_of(args, 1, TEXT_P("Value"), max);
}

WORD(mon_cid)
{
    int16_t id = id_of(args, DXL_BROADCAST);
    if (id != BAD) {
        the_editor.cid = (uint8_t)id;
    }
    return SHELL_OK;
}

WORD(mon_ping)
{
    int16_t id = args->count == 1 ? the_editor.cid : id_of(args, DXL_BROADCAST);
    if (id != BAD) {
        (void)transact((uint8_t)id, DXL_PING, 0);
    }
    return SHELL_OK;
}

WORD(mon_read)
{
    int16_t at = number_of(args, 1, TEXT_P("Address"), TABLE_BYTES - 1), count = 1;
    if (at == BAD || !is_one_servo()) {
        return SHELL_OK;
    }
    if (args->count > 2) {
        count = number_of(args, 2, TEXT_P("Count"), (uint16_t)(TABLE_BYTES - at));
    }
    params()[0] = (uint8_t)at;
    params()[1] = (uint8_t)count;
    if (count != BAD) {
        (void)transact(the_editor.cid, DXL_READ, 2);
    }
    return SHELL_OK;
}

WORD(mon_write)
{
    return send_words(args, DXL_WRITE);
}

WORD(mon_reg_write)
{
    return send_words(args, DXL_REG_WRITE);
}

WORD(mon_action)
{
    (void)transact(the_editor.cid, DXL_ACTION, 0);
    return SHELL_OK;
}

WORD(mon_go)
{
    int16_t speed = 0, pos = number_of(args, 1, TEXT_P("Position"), PAGE_POS_MAX);
    uint8_t count = 3;
    if (pos != BAD && args->count > 2) {
        speed = number_of(args, 2, TEXT_P("Speed"), PAGE_POS_MAX);
        count = 5;
    }
    uint8_t *to = params();
    *to++ = DXL_AT_GOAL;
    *to++ = (uint8_t)pos;
    *to++ = (uint8_t)((uint16_t)pos >> 8);
    *to++ = (uint8_t)speed;
    *to = (uint8_t)((uint16_t)speed >> 8);
    if (pos != BAD && speed != BAD) {
        (void)transact(the_editor.cid, DXL_WRITE, count);
    }
    return SHELL_OK;
}

WORD(mon_led)
{
    (void)send_value(DXL_AT_LED, value_of(args, 1));
    return SHELL_OK;
}

/* A new ID must be free: two servos with one ID can only be told apart by unplugging one. */
WORD(mon_id)
{
    int16_t id = is_one_servo() ? id_of(args, ID_MAX) : BAD;
    if (id == BAD) {
        return SHELL_ERR_SAID;
    }
    if (bus_call_ping((uint8_t)id, TRIES, NULL) == BUS_OK) {
        return say(TEXT_P("That ID is taken"));
    }
    if (send_value(DXL_AT_ID, id)) {
        the_editor.cid = (uint8_t)id;
    }
    return SHELL_OK;
}

WORD(mon_baud)
{
    if (is_one_servo()) {
        (void)send_value(DXL_AT_BAUD, value_of(args, DXL_BROADCAST));
    }
    return SHELL_OK;
}

WORD(mon_reset)
{
    if (!is_one_servo()) {
        return SHELL_ERR_SAID;
    }
    if (!shell_word_is(args, 1, PSTR("yes"))) {
        return say(TEXT_P("RESET YES: factory values, ID 1"));
    }
    (void)transact(the_editor.cid, DXL_RESET, 0);
    return SHELL_OK;
}

/* swr address count, then for each servo its ID and `count` bytes. */
WORD(mon_sync_write)
{
    uint8_t count = bytes_of(args), each = params()[1];
    (void)context;
    if (count < 4 || each == 0 || (uint16_t)(count - 2) % (uint16_t)(each + 1) != 0) {
        return say(TEXT_P("SWR address count id byte .. id byte .."));
    }
    (void)transact(DXL_BROADCAST, DXL_SYNC_WRITE, count);
    return SHELL_OK;
}

static void scan(uint8_t last)
{
    uint8_t found = 0;
    TEXT(" ID:");
    for (uint8_t id = 0; id <= last; id++) {
        system_kick();
        if (bus_call_ping(id, 1, NULL) == BUS_OK) {
            text_put(' ');
            text_padded(id, 3, '0');
            found++;
        }
    }
    text_put(' ');
    text_padded(found, 3, '0');
    (void)say(TEXT_P(" Dynamixels Found."));
}

WORD(mon_scan)
{
    int16_t last = args->count == 1 ? SCAN_LAST : id_of(args, ID_MAX);
    (void)context;
    if (last != BAD) {
        scan((uint8_t)last);
    }
    return SHELL_OK;
}

WORD(mon_search)
{
    (void)context;
    bus_set_rate(BUS_RATE_57142);
    TEXT("57142 bps");
    scan(ID_MAX);
    bus_set_rate(BUS_RATE_1M);
    TEXT("1000000 bps");
    scan(ID_MAX);
    return SHELL_OK;
}

WORD(mon_dump)
{
    uint8_t row[DUMP_ROW];
    for (uint8_t at = 0; at < TABLE_BYTES && is_one_servo(); at = (uint8_t)(at + DUMP_ROW)) {
        bus_status_t status = bus_call_read(the_editor.cid, at, row, DUMP_ROW, NULL);
        if (status != BUS_OK) {
            return say(status_text_P(status));
        }
        text_padded(at, 3, '0');
        print_bytes(TEXT_P(":"), row, DUMP_ROW);
        text_line_end();
    }
    return SHELL_OK;
}

/* Servos may have another ID now: what is there is looked up anew. The page was never touched. */
WORD(mon_exit)
{
    bus_set_rate(BUS_RATE_1M);
    servo_link_scan(&the_servos);
    screen_set_present(the_servos.present);
    robot_read();
    screen_show();
    editor_leave_line();
    return SHELL_OK;
}

WORD(mon_toss_start)
{
    (void)say(TEXT_P("Three ESC end it"));
    mon_toss();
    text_line_end();
    return SHELL_OK;
}

/* ---- the table ---- */

WORD(mon_help);


TEXT_NAMED(word_help, "help ? ");
TEXT_NAMED(word_dump, "dump d ");
TEXT_NAMED(word_id, "id  n");
TEXT_NAMED(word_cid, "cid  id  whom it is for");
TEXT_NAMED(word_read, "read r address [count]");
TEXT_NAMED(word_write, "write w address byte ..");
TEXT_NAMED(word_reg_wr, "reg_wr  address byte ..");
TEXT_NAMED(word_action, "action  ");
TEXT_NAMED(word_go, "go g position [speed]");
TEXT_NAMED(word_hex, "hex  ");
TEXT_NAMED(word_dec, "dec  ");
TEXT_NAMED(word_reset, "reset  ");
TEXT_NAMED(word_ping, "ping  [id]");
TEXT_NAMED(word_swr, "swr  ");
TEXT_NAMED(word_scan, "scan  [id]");
TEXT_NAMED(word_led, "led  n");
TEXT_NAMED(word_baud, "baud  n");
TEXT_NAMED(word_search, "search  ");
TEXT_NAMED(word_toss, "toss  ");
TEXT_NAMED(word_exit, "exit  ");

static const shell_command_t table_P[] PROGMEM = {
    { word_help, mon_help, SHELL_ARGS(0, 1), 0 },
    { word_dump, mon_dump, SHELL_ARGS(0, 1), 0 },
    { word_id, mon_id, SHELL_ARGS(1, 1), 0 },
    { word_cid, mon_cid, SHELL_ARGS(1, 1), 0 },
    { word_read, mon_read, SHELL_ARGS(1, 2), 0 },
    { word_write, mon_write, SHELL_ARGS(2, SHELL_ANY_ARGS), 0 },
    { word_reg_wr, mon_reg_write, SHELL_ARGS(2, SHELL_ANY_ARGS), 0 },
    { word_action, mon_action, SHELL_ARGS(0, 0), 0 },
    { word_go, mon_go, SHELL_ARGS(1, 2), 0 },
    { word_hex, cmd_hex, SHELL_ARGS(0, 0), 0 },
    { word_dec, cmd_dec, SHELL_ARGS(0, 0), 0 },
    { word_reset, mon_reset, SHELL_ARGS(0, 1), 0 },
    { word_ping, mon_ping, SHELL_ARGS(0, 1), 0 },
    { word_swr, mon_sync_write, SHELL_ARGS(3, SHELL_ANY_ARGS), 0 },
    { word_scan, mon_scan, SHELL_ARGS(0, 1), 0 },
    { word_led, mon_led, SHELL_ARGS(1, 1), 0 },
    { word_baud, mon_baud, SHELL_ARGS(1, 1), 0 },
    { word_search, mon_search, SHELL_ARGS(0, 0), 0 },
    { word_toss, mon_toss_start, SHELL_ARGS(0, 0), 0 },
    { word_exit, mon_exit, SHELL_ARGS(0, 0), 0 },
};
#define WORDS (sizeof table_P / sizeof table_P[0])

WORD(mon_help)
{
    (void)context;
    for (uint8_t i = 0; i < WORDS; i++) {
        shell_print_help(&table_P[i]);
    }
    return SHELL_OK;
}

/* ---- in and out of the monitor ---- */

void mon_prompt(void)
{
    TEXT(" [CID:");
    text_padded(the_editor.cid, 3, '0');
    TEXT("(0X");
    text_hex(the_editor.cid, 2);
    TEXT(")] ");
}

void mon_line(const shell_args_t *args)
{
    servo_link_quiet(&the_servos);
    uint8_t result = shell_run(table_P, WORDS, NULL, args);
    if (result >= SHELL_ERR_UNKNOWN) {
        (void)say(result == SHELL_ERR_UNKNOWN ? TEXT_P(" Bad Command") : TEXT_P(" Invalid Parameter"));
    }
}

COMMAND(cmd_mon)
{
    (void)args;
    if (!editor_may_move()) {
        return SHELL_ERR_SAID;
    }
    if (!editor_ask_unsaved()) {
        return EDITOR_TO_ASK;
    }
    servo_link_quiet(&the_servos);
    screen_hide();
    mon_prompt();
    return EDITOR_TO_MONITOR;
}
