/* SPDX-License-Identifier: MIT */
#include "shell.h"

#include <stddef.h>
#include <string.h>
#include "compiler.h"
#include "text.h"

enum {
    KEY_RECALL = 0x01, /* Ctrl-A */
    KEY_BEL = 0x07,
    KEY_BS = 0x08,
    KEY_LF = 0x0A,
    KEY_CR = 0x0D,
    KEY_EMPTY = 0x15, /* Ctrl-U */
    KEY_ESC = 0x1B,
    KEY_DEL = 0x7F
};

/*            ESC            [ or O            0x40..0x7E
 *  ESC_NONE -----> ESC_BEGUN -----> ESC_BODY -----------> ESC_NONE
 *                     | any other byte                ^ (parameters stay in ESC_BODY)
 *                     +--> ESC_NONE                                                       */
enum { ESC_NONE = 0, ESC_BEGUN, ESC_BODY };

/* ---- line editor ---- */

void shell_init(shell_t *shell, char *line, uint8_t line_bytes, char *history, uint8_t history_bytes)
{
    memset(shell, 0, sizeof *shell);
    shell->line = line;
    shell->line_bytes = line_bytes;
    shell->history = history;
    shell->history_bytes = history_bytes;
    line[0] = '\0';
    if (history_bytes > 0) {
        memset(history, 0, history_bytes);
    }
}

void shell_clear(shell_t *shell)
{
    shell->length = 0;
    shell->recalled = 0;
    shell->too_long = false;
    shell->line[0] = '\0';
}

static void rub_out(shell_t *shell)
{
    if (shell->length > 0) {
        shell->length--;
        text_put(KEY_BS);
        text_put(' ');
        text_put(KEY_BS);
    }
}

static void empty_line(shell_t *shell)
{
    while (shell->length > 0) {
        rub_out(shell);
    }
    shell->too_long = false;
}

static void type(shell_t *shell, char character)
{
    if (shell->length + 1u >= shell->line_bytes) {
        shell->too_long = true;
        text_put(KEY_BEL);
        return;
    }
    shell->line[shell->length++] = character;
    text_put(character);
}

/* The line that was typed `back` lines ago (1 = the last one), or NULL. */
static const char *history_line(const shell_t *shell, uint8_t back)
{
    const char *line = shell->history;
    if (shell->history_bytes == 0) {
        return NULL;
    }
    while (*line != '\0') {
        if (--back == 0) {
            return line;
        }
        line += strlen(line) + 1;
    }
    return NULL;
}

/* Puts the line `back` lines ago in place of this one; 0 empties it; beyond the oldest nothing happens. */
static void recall(shell_t *shell, uint8_t back)
{
    const char *line = back == 0 ? "" : history_line(shell, back);
    if (line == NULL) {
        return;
    }
    empty_line(shell);
    shell->recalled = back;
    while (*line != '\0') {
        type(shell, *line++);
    }
}

/* Newest first: older lines move up; what no longer fits whole is dropped at the far end. */
static void remember(shell_t *shell)
{
    const uint8_t bytes = (uint8_t)(shell->length + 1);
    if (shell->length == 0 || bytes + 1u > shell->history_bytes) {
        return;
    }
    const char *last = history_line(shell, 1);
    if (last != NULL && strcmp(last, shell->line) == 0) {
        return;
    }
    memmove(shell->history + bytes, shell->history, (size_t)(shell->history_bytes - bytes));
    memcpy(shell->history, shell->line, bytes);
    /* The last byte ends the list. The oldest line may have been cut: then the list ends behind the NUL before it. */
    char *end = shell->history + shell->history_bytes;
    do {
        *--end = '\0';
    } while (end[-1] != '\0');
}

/* true when the byte belonged to an escape sequence. */
static bool swallow_escape(shell_t *shell, uint8_t byte)
{
    switch (shell->escape) {
    case ESC_NONE:
        if (byte != KEY_ESC) {
            return false;
        }
        shell->escape = ESC_BEGUN;
        return true;
    case ESC_BEGUN:
        if (byte != KEY_ESC) {
            shell->escape = byte == '[' || byte == 'O' ? ESC_BODY : ESC_NONE;
        }
        return true;
    default:
        if (byte < 0x20) { /* a control character breaks a sequence off and counts */
            shell->escape = byte == KEY_ESC ? ESC_BEGUN : ESC_NONE;
            return byte == KEY_ESC;
        }
        if (byte >= 0x40) {
            shell->escape = ESC_NONE;
            if (byte == 'A') {
                recall(shell, (uint8_t)(shell->recalled + 1));
            } else if (byte == 'B' && shell->recalled > 0) {
                recall(shell, (uint8_t)(shell->recalled - 1));
            }
        }
        return true;
    }
}

static void control_key(shell_t *shell, uint8_t byte)
{
    if (byte == KEY_BS || byte == KEY_DEL) {
        rub_out(shell);
    } else if (byte == KEY_RECALL) {
        recall(shell, (uint8_t)(shell->recalled + 1));
    } else if (byte == KEY_EMPTY) {
        empty_line(shell);
    }
}

shell_event_t shell_byte(shell_t *shell, uint8_t byte)
{
    const bool lf_of_cr = byte == KEY_LF && shell->after_cr;
    shell->after_cr = byte == KEY_CR;
    if (lf_of_cr || swallow_escape(shell, byte)) {
        return SHELL_TYPING;
    }
    if (byte == KEY_CR || byte == KEY_LF) {
        shell->line[shell->length] = '\0';
        return shell->too_long ? SHELL_TOO_LONG : SHELL_LINE;
    }
    if (byte < 0x20 || byte >= KEY_DEL) {
        control_key(shell, byte);
    } else {
        type(shell, (char)byte);
    }
    return SHELL_TYPING;
}

/* ---- words ---- */

static bool is_separator(char character)
{
    return character == ' ' || character == ',' || character == '.' || character == ':' || character == ';';
}

shell_args_t shell_split(shell_t *shell, bool hex)
{
    remember(shell);
    shell_args_t args = {.words = shell->line, .count = 0, .hex = hex};
    char *to = shell->line;
    bool inside = false;
    for (const char *from = shell->line; *from != '\0'; from++) {
        if (!is_separator(*from)) {
            args.count = (uint8_t)(args.count + (inside ? 0 : 1));
            inside = true;
            *to++ = *from;
        } else if (inside) {
            inside = false;
            *to++ = '\0';
        }
    }
    *to = '\0';
    return args;
}

const char *shell_word(const shell_args_t *args, uint8_t index)
{
    if (index >= args->count) {
        return "";
    }
    const char *word = args->words;
    while (index-- > 0) {
        word += strlen(word) + 1;
    }
    return word;
}

bool shell_word_is(const shell_args_t *args, uint8_t index, const char *word_P)
{
    return strcasecmp_P(shell_word(args, index), word_P) == 0;
}

/* ---- numbers ---- */

/* Value of a hexadecimal digit, 0..15; 16: it is none. */
static uint8_t digit_of(char character)
{
    if (character >= '0' && character <= '9') {
        return (uint8_t)(character - '0');
    }
    const char lower = (char)(character | 0x20);
    return lower >= 'a' && lower <= 'f' ? (uint8_t)(lower - 'a' + 10) : 16;
}

bool shell_hex(const char *digits, uint8_t count, uint16_t *value)
{
    *value = 0;
    for (; count > 0; count--) {
        const uint8_t digit = digit_of(*digits++);
        if (digit > 15) {
            return false;
        }
        *value = (uint16_t)(*value << 4 | digit);
    }
    return true;
}

bool shell_parse(const char *word, bool hex, uint16_t *value)
{
    if (word[0] == '0' && (word[1] | 0x20) == 'x') {
        hex = true;
        word += 2;
    }
    if (*word == '\0') {
        return false;
    }
    const uint8_t base = hex ? 16 : 10;
    const uint16_t sum_max = hex ? UINT16_MAX / 16 : UINT16_MAX / 10; /* before another digit */
    uint16_t sum = 0;
    for (; *word != '\0'; word++) {
        const uint8_t digit = digit_of(*word);
        if (digit >= base) {
            return false;
        }
        const uint16_t next = (uint16_t)(sum * base + digit);
        if (sum > sum_max || next < digit) { /* 6553 tens take five more, and start anew then */
            return false;
        }
        sum = next;
    }
    *value = sum;
    return true;
}

/* The range that shell_take looked at last. */
static struct {
    const shell_range_t *range_P;
    bool hex;
} broken;

/* Not inlined twice. */
static NOINLINE void print_bound(int16_t number, bool hex)
{
    if (!hex) {
        text_signed(number);
        return;
    }
    TEXT("0x");
    text_hex((uint16_t)number, number > 0xFF ? 4 : 2);
}

void shell_print_range(const char *what_P, int16_t min, int16_t max, bool hex)
{
    text_P(what_P);
    TEXT(" must be ");
    print_bound(min, hex);
    TEXT("..");
    print_bound(max, hex);
}

bool shell_take(const shell_args_t *args, uint8_t index, uint8_t range, uint16_t *value)
{
    uint16_t size;
    const shell_range_t *range_P = shell_range_P(range);
    const char *word = shell_word(args, index);
    const bool negative = *word == '-';
    broken.range_P = range_P;
    broken.hex = args->hex;
    if (!shell_parse(word + negative, args->hex, &size) || size > INT16_MAX) {
        return false;
    }
    const int16_t number = negative ? (int16_t)-(int16_t)size : (int16_t)size;
    if (number < (int16_t)pgm_read_word(&range_P->min) || number > (int16_t)pgm_read_word(&range_P->max)) {
        return false;
    }
    *value = (uint16_t)number;
    return true;
}

void shell_print_broken(void)
{
    const shell_range_t *range_P = broken.range_P;
    shell_print_range(pgm_read_ptr(&range_P->name_P), (int16_t)pgm_read_word(&range_P->min),
                      (int16_t)pgm_read_word(&range_P->max), broken.hex);
}

/* ---- commands ---- */

/* Takes the reader behind the next space. true: what stood before it is `word`. */
static bool field_is(text_reader_t *reader, const char *word)
{
    uint8_t differs = 0;
    for (char character; (character = text_next(reader)) != ' ';) {
        const char typed = *word >= 'A' && *word <= 'Z' ? (char)(*word | 0x20) : *word;
        differs |= (uint8_t)(typed ^ character);
        word += *word != '\0';
    }
    return (differs | (uint8_t)*word) == 0;
}

const shell_command_t *shell_find(const shell_command_t *table_P, uint8_t count, const shell_args_t *args,
                                  uint8_t index)
{
    const char *word = shell_word(args, index);
    for (; count > 0 && *word != '\0'; count--, table_P++) {
        text_reader_t reader;
        text_open_P(&reader, pgm_read_ptr(&table_P->text));
        const bool is_word = field_is(&reader, word);
        if (is_word || field_is(&reader, word)) {   /* the short form is the next field */
            return table_P;
        }
    }
    return NULL;
}

/* The first two words behind the command as numbers, where `ranges` says that they are some. */
static bool take_numbers(shell_args_t *args, uint16_t ranges)
{
    for (uint8_t i = 0; i < ARRAY_COUNT(args->number); i++, ranges >>= 8) {
        args->number[i] = 0;
        if ((uint8_t)ranges != 0 && i + 1 < args->count &&
            !shell_take(args, (uint8_t)(i + 1u), (uint8_t)ranges, &args->number[i])) {
            return false;
        }
    }
    return true;
}

uint8_t shell_run(const shell_command_t *table_P, uint8_t count, void *context, shell_args_t *args, bool moving)
{
    shell_command_t found;
    if (args->count == 0) {
        return SHELL_OK;
    }
    const shell_command_t *found_P = shell_find(table_P, count, args, 0);
    if (found_P == NULL) {
        return SHELL_ERR_UNKNOWN;
    }
    memcpy_P(&found, found_P, sizeof found);
    const uint8_t given = (uint8_t)(args->count - 1), most = found.args & 0x0Fu;
    if (given < (found.args >> 4 & 7u) || (given > most && most != SHELL_ANY_ARGS)) {
        return SHELL_ERR_COUNT;
    }
    if (moving && (found.args & SHELL_STILL) != 0) {
        return SHELL_ERR_MOVING;
    }
    if (!take_numbers(args, found.numbers)) {
        return SHELL_ERR_RANGE;
    }
    return found.handler(context, args);
}

static void print_field(text_reader_t *reader, uint8_t columns)
{
    for (char character; (character = text_next(reader)) != ' '; columns--) {
        text_put(character);
    }
    for (; columns > 0; columns--) {
        text_put(' ');
    }
}

void shell_print_help(const shell_command_t *command_P)
{
    text_reader_t reader;
    text_open_P(&reader, pgm_read_ptr(&command_P->text));
    print_field(&reader, SHELL_WORD_COLUMNS);
    print_field(&reader, SHELL_SHORT_COLUMNS);
    for (char character; (character = text_next(&reader)) != '\0';) {
        text_put(character);
    }
    text_line_end();
}
