/* SPDX-License-Identifier: MIT
 * shell_words.c - the words of a line, and their parsing as numbers. */
#include "shell.h"

#include <stddef.h>
#include <string.h>
#include "compiler.h"
#include "text.h"

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

/* The value of a hexadecimal digit, 0..15; 16: not a digit. */
static uint8_t digit_of(char character)
{
    if (character >= '0' && character <= '9') {
        return (uint8_t)(character - '0');
    }
    const char lower = character | 0x20;
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
    const uint16_t sum_max = hex ? UINT16_MAX / 16 : UINT16_MAX / 10; /* if another digit follows */
    uint16_t sum = 0;
    for (; *word != '\0'; word++) {
        const uint8_t digit = digit_of(*word);
        if (digit >= base) {
            return false;
        }
        const uint16_t next = (uint16_t)(sum * base + digit);
        if (sum > sum_max || next < digit) { /* 65536..65539 pass the first test and wrap */
            return false;
        }
        sum = next;
    }
    *value = sum;
    return true;
}

/* The range that shell_take checked last. */
static struct {
    const shell_range_t *range_P;
    bool hex;
} checked;

static void print_bound(int16_t number, bool hex)
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
    return shell_take_word(shell_word(args, index), args->hex, range, value);
}

bool shell_take_word(const char *word, bool hex, uint8_t range, uint16_t *value)
{
    uint16_t size;
    const shell_range_t *range_P = shell_range_P(range);
    const bool negative = *word == '-';
    checked.range_P = range_P;
    checked.hex = hex;
    if (!shell_parse(word + negative, hex, &size) || size > INT16_MAX) {
        return false;
    }
    const int16_t number = negative ? -(int16_t)size : (int16_t)size;
    if (number < (int16_t)pgm_read_word(&range_P->min) || number > (int16_t)pgm_read_word(&range_P->max)) {
        return false;
    }
    *value = (uint16_t)number;
    return true;
}

void shell_print_range_error(void)
{
    const shell_range_t *range_P = checked.range_P;
    shell_print_range(pgm_read_ptr(&range_P->name_P), (int16_t)pgm_read_word(&range_P->min),
                      (int16_t)pgm_read_word(&range_P->max), checked.hex);
}
