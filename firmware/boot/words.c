/* SPDX-License-Identifier: MIT */
#include "words.h"

#include "check.h"
#include "load.h"
#include "memory.h"
#include "start.h"
#include "print.h"
#include "uart.h"

#include <string.h>

#define DUMP_LINES 8
#define ERASED 0xFF
#define CLEAR_DOT 256u

/* One code for each word and its aliases, in the order of `limits`. From PLAY on, a word stores a byte for an
 * application. */
enum { HELP, FLASH, EEPROM, RAM, LOAD, UP, EEP_UP, EEP_DN, VERIFY, CLEAR, GO, FORCE, RESET, APP, SYS, CHECK, ID,
       PLAY, TOSS, MON, EDIT, DUMP, WORD_CODES, UNKNOWN = 0xFF };

/* Words, each followed by 0x80 + code, in the order of HELP. */
static const char words[] PROGMEM =
    "HELP\x80" "FLASH\x81" "F\x81" "EEPROM\x82" "EEP\x82" "E\x82" "RAM\x83" "R\x83"
    "LOAD\x84" "LD\x84" "L\x84" "DOWN\x84" "DN\x84" "UP\x85" "EEP_UP\x86" "EEP_DN\x87" "VERIFY\x88" "V\x88"
    "CLEAR_EEPROM\x89" "GO\x8A" "G\x8A" "FORCE\x8B" "RESET\x8C" "APPLICATION\x8D" "APP\x8D" "SYSTEM\x8E" "SYS\x8E"
    "CHECK\x8F" "ID\x90" "PLAY\x91" "TOSS\x92" "MONITOR\x93" "MON\x93" "EDIT\x94" "DUMP\x95";

/* Numbers of arguments: the minimum in the high nibble, the maximum in the low one. */
static const uint8_t limits[WORD_CODES] PROGMEM_GAP = {
    [FLASH] = 0x01, [EEPROM] = 0x01, [RAM] = 0x01, [LOAD] = 0x01, [UP] = 0x22, [EEP_UP] = 0x22, [EEP_DN] = 0x22,
    [CLEAR] = 0x02, [GO] = 0x01};

/* The end of the memory that the word's address and length refer to, in units of 4 KiB; 1 for words without. A dump that
 * would run past the end of RAM begins at 0. */
static const uint8_t ends[WORD_CODES] PROGMEM_GAP = {
    [HELP] = 1, [FLASH] = MEM_BOOT_END / 4096, [EEPROM] = MEM_EEPROM_BYTES / 4096, [RAM] = MEM_RAM_END / 4096 + 1,
    [LOAD] = MEM_BOOT_START / 4096, [UP] = MEM_BOOT_END / 4096, [EEP_UP ... CLEAR] = MEM_EEPROM_BYTES / 4096,
    [GO] = 0x10000 / 4096, [FORCE ... DUMP] = 1};

/* The code of `word`, which is not empty. */
static uint8_t find(const char *word)
{
    const char *entry = words;
    while (entry < words + sizeof words - 1) {
        const char *p = word;
        uint8_t c;
        bool same = true;
        while ((c = print_byte(entry++)) < 0x80) {
            same = same && c == (uint8_t)*p++;
        }
        if (same && *p == 0) {
            return c & 0x7F;
        }
    }
    return UNKNOWN;
}

/* Prints all words, then a line for newcomers. */
static void help(void)
{
    print_line();
    for (const char *entry = words; entry < words + sizeof words - 1; entry++) {
        uint8_t c = print_byte(entry);
        uart_put(c < 0x80 ? c : ' ');
    }
    SAY("Hex; # at reset stays");
}

/* Prints a dump. Without an argument it continues where the last dump or transfer ended. */
static void dump(uint8_t code, const parse_t *line)
{
    if (line->count > 0) {
        memory_seek(line->arg[0]);
    }
    uint8_t space = code == EEPROM ? MEMORY_EEPROM >> 16 : code == RAM ? MEMORY_RAM >> 16 : 0;
    for (uint8_t row = 0; row < DUMP_LINES; row++) {
        uint8_t bytes[16];
        memory_cursor.byte[3] = 0;
        memory_cursor.byte[2] &= code == FLASH;
        if (code == EEPROM) {
            memory_cursor.byte[1] &= (MEM_EEPROM_BYTES - 1) >> 8;
        } else if (code == RAM && memory_cursor.low > MEM_RAM_END - sizeof bytes) {
            memory_cursor.low = 0;
        }
        print_line();
        print_hex32(memory_cursor.addr);
        PUT(" : ");
        memory_cursor.byte[2] |= space;
        memory_fetch(bytes, sizeof bytes);
        for (uint8_t i = 0; i < 16; i++) {
            print_hex8(bytes[i]);
            uart_put(' ');
        }
        for (uint8_t i = 0; i < 16; i++) {
            uart_put(bytes[i] >= ' ' && bytes[i] < 0x80 ? bytes[i] : '.');
        }
    }
    PUT("\r\n");
}

/* Sums flash from 0 on, so it checks only downloads to 0: they are correct if the second sum equals the third. */
static void verify(void)
{
    load_record_t record;
    uint32_t sum = 0;
    memory_seek(MEMORY_EEPROM + MEM_EE_LOAD_RECORD);
    memory_fetch(&record, sizeof record);
    SAY("Program Length : 0x");
    print_hex32(record.size);
    SAY("Verified Checksum : ");
    print_hex8(record.last);
    uart_put('-');
    if (record.size > MEM_BOOT_END) {
        record.size = MEM_BOOT_END;
    }
    memory_seek(0);
    while (record.size-- > 1) {
        sum += memory_next();
    }
    print_hex32(sum);
    uart_put('-');
    print_hex32(record.sum);
}

static void clear_eeprom(const parse_t *line)
{
    uint16_t at = (uint16_t)line->arg[0] /* 0 if there is none */, count = (uint16_t)line->arg[1];
    if (line->count == 1) {
        return;
    }
    if (line->count == 0) {
        SAY("Sure? (y/N)");
        while (!uart_has()) {
        }
        if ((uart_next() & 0xDF) != 'Y') {
            return;
        }
        count = MEM_EEPROM_BYTES;
    }
    SAY("EEPROM Clearing");
    for (; count > 0; count--) {
        memory_ee_set(at++, ERASED);
        if (line->count == 0 && at % CLEAR_DOT == 0) {
            uart_put('.');
        }
    }
}

void words_go(uint16_t word, bool force)
{
    memory_app_t app = word == 0 ? memory_app() : MEMORY_APP_PLAIN;
    SAY("Jump Address : 0x");
    print_hex32(word);
    if (app == MEMORY_APP_NONE || (app == MEMORY_APP_BAD && !force)) {
        print_line();
        print_nth(PSTR("No application.\0Damaged: FORCE starts it."), app == MEMORY_APP_BAD);
        return;
    }
    start_jump(word);
}

static void set_start(uint8_t code)
{
    static const char names[] PROGMEM_GAP = "Play\0Toss\0Monitor\0Motion Edit\0DUMP485";
    memory_ee_set(MEM_EE_START_WORD, 0x12 + code - PLAY);
    print_line();
    print_nth(names, code - PLAY);
    PUT(" Mode");
}

/* Whether address and length are within the word's memory. Numbers have 20 bits, so the sum does not overflow, and as a
 * number of pages it fits 16. */
static bool is_in_range(uint8_t code, const parse_t *line)
{
    uint16_t pages = (uint16_t)((line->arg[0] + line->arg[1] + 0xFF) >> 8);
    return pages <= print_byte(&ends[code]) * 16u && (code != EEP_DN || line->arg[1] <= MEMORY_WORK_BYTES);
}

static void run(uint8_t code, const parse_t *line)
{
    uint32_t first = line->arg[0];
    switch (code) {
    case HELP: help(); break;
    case FLASH:
    case EEPROM:
    case RAM: dump(code, line); break;
    case LOAD: load_flash(first); break;
    case EEP_UP: first += MEMORY_EEPROM; /* fall through */
    case UP: load_send(first, line->arg[1]); break;
    case EEP_DN: load_eeprom((uint16_t)first, (uint16_t)line->arg[1]); break;
    case VERIFY: verify(); break;
    case CLEAR: clear_eeprom(line); break;
    case GO:
    case FORCE: words_go((uint16_t)first, code == FORCE); break;
    case RESET: start_reset();
    case APP:
    case SYS:
        memory_ee_set(MEM_EE_BOOT_MODE, code == APP ? START_MODE_APPLICATION : START_MODE_SYSTEM);
        SAY("Boot to ");
        print_nth(PSTR("Application\0System"), code == SYS);
        break;
    case CHECK: check_all(); break;
    case ID: check_id(); break;
    default: set_start(code);
    }
}

static void usage(const char *word)
{
    print_line();
    while (*word != 0) {
        uart_put(*word++);
    }
    PUT(" StartAddress, Length");
}

void words_run(const parse_t *line, parse_status_t status)
{
    uint8_t code = find(line->word);
    if (code == UNKNOWN) {
        SAY("Bad Command.(see 'help')");
        return;
    }
    uint8_t limit = print_byte(&limits[code]);
    if (limit == 0x22 && line->count != 2 && status == PARSE_OK) {
        usage(line->word);
    } else if (status != PARSE_OK || line->count > (limit & 15)) {
        SAY("Bad Argument.");
    } else if (!is_in_range(code, line)) {
        SAY("Bad Address.");
    } else {
        run(code, line);
    }
}
