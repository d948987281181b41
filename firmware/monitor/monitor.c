/* SPDX-License-Identifier: MIT
 * monitor.c - prompt, lines and table of the servo bus monitor (edit/ORIGINAL.md section 11), and the words for the whole
 * bus. servo_words.c has the words for one servo. */
#include "monitor.h"

#include "console.h"
#include "packets.h"
#include "pgm.h"
#include "ranges_own.h"
#include "search.h"
#include "servo_words.h"
#include "system.h"
#include "text.h"

enum { SCAN_LAST = 127 };

static bool hex;    /* numbers are hexadecimal */

/* ---- words ---- */

static WORD(mon_scan)
{
    search_ids(args->count > 1 ? (uint8_t)args->number[0] : SCAN_LAST);
    return SHELL_OK;
}

static WORD(mon_search)
{
    search_rates();
    return SHELL_OK;
}

static WORD(mon_fast)
{
    search_make_fast();
    return SHELL_OK;
}

static WORD(mon_hex)
{
    hex = true;
    return SHELL_OK;
}

static WORD(mon_dec)
{
    hex = false;
    return SHELL_OK;
}

static WORD(mon_exit)
{
    console_flush();
    system_restart();
    return SHELL_OK;   /* never reached */
}

static WORD(mon_toss)
{
    static uint8_t heard[TOSS_BUFFER_BYTES];
    (void)packets_say(TEXT_P("Three ESC end it"));
    toss_run(heard);
    text_line_end();
    return SHELL_OK;
}

/* ---- the table ---- */

static WORD(mon_help);

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
TEXT_NAMED(word_baud, "baud  1|34  1 Mbps or 57142 bps");
TEXT_NAMED(word_search, "search  who is there, at both rates");
TEXT_NAMED(word_fast, "fast  moves servos at 57142 bps to 1 Mbps");
TEXT_NAMED(word_toss, "toss  packets of the PC to the servos and back");
TEXT_NAMED(word_exit, "exit  restarts the controller");

static const shell_command_t table_P[] PROGMEM = {
    { word_help, mon_help, SHELL_ARGS(0, 1), 0 },
    { word_dump, servo_words_dump, SHELL_ARGS(0, 1), 0 },
    { word_id, servo_words_id, SHELL_ARGS(1, 1), RANGE_ONE_ID },
    { word_cid, servo_words_cid, SHELL_ARGS(1, 1), RANGE_BUS_ID },
    { word_read, servo_words_read, SHELL_ARGS(1, 2), SHELL_BOTH(RANGE_ADDRESS, RANGE_COUNT) },
    { word_write, servo_words_write, SHELL_ARGS(2, SHELL_ANY_ARGS), 0 },
    { word_reg_wr, servo_words_reg_write, SHELL_ARGS(2, SHELL_ANY_ARGS), 0 },
    { word_action, servo_words_action, SHELL_ARGS(0, 0), 0 },
    { word_go, servo_words_go, SHELL_ARGS(1, 2), SHELL_BOTH(RANGE_POSITION, RANGE_MOVING_SPEED) },
    { word_hex, mon_hex, SHELL_ARGS(0, 0), 0 },
    { word_dec, mon_dec, SHELL_ARGS(0, 0), 0 },
    { word_reset, servo_words_reset, SHELL_ARGS(0, 1), 0 },
    { word_ping, servo_words_ping, SHELL_ARGS(0, 1), RANGE_BUS_ID },
    { word_swr, servo_words_sync_write, SHELL_ARGS(3, SHELL_ANY_ARGS), 0 },
    { word_scan, mon_scan, SHELL_ARGS(0, 1), RANGE_ONE_ID },
    { word_led, servo_words_led, SHELL_ARGS(1, 1), RANGE_SWITCH },
    { word_baud, servo_words_baud, SHELL_ARGS(1, 1), RANGE_BYTE },
    { word_search, mon_search, SHELL_ARGS(0, 0), 0 },
    { word_fast, mon_fast, SHELL_ARGS(0, 0), 0 },
    { word_toss, mon_toss, SHELL_ARGS(0, 0), 0 },
    { word_exit, mon_exit, SHELL_ARGS(0, 0), 0 },
};

static WORD(mon_help)
{
    for (uint8_t i = 0; i < ARRAY_COUNT(table_P); i++) {
        shell_print_help(&table_P[i]);
    }
    return SHELL_OK;
}

/* ---- lines ---- */

void monitor_init(void)
{
    servo_words_init();
}

void monitor_prompt(void)
{
    TEXT(" [CID:");
    text_padded(servo_words_current(), 3, '0');
    TEXT("(0X");
    text_hex(servo_words_current(), 2);
    TEXT(")] ");
}

void monitor_line(shell_t *shell)
{
    shell_args_t args;
    shell_split(shell, hex, &args);
    switch (shell_run(table_P, ARRAY_COUNT(table_P), &args, false)) {
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
