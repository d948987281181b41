/* SPDX-License-Identifier: MIT */
#include "cli_text.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool cli_duration(const char *text, uint64_t *cycles)
{
    static const struct { const char *name; double cycles; } units[] = {
        {"cycles", 1}, {"us", 16}, {"ms", 16e3}, {"s", 16e6}, {"min", 960e6}, {"ticks", 125e3}, {"tick", 125e3}};
    char *end;
    const double value = strtod(text, &end);
    if (end == text || !isfinite(value) || value < 0 || value > 1e9) {
        return false;
    }
    if (*end == 0 && value == 0) {
        *cycles = 0;
        return true;
    }
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        if (strcmp(end, units[i].name) == 0) {
            *cycles = (uint64_t)(value * units[i].cycles + 0.5);
            return true;
        }
    }
    return false;
}

bool cli_number(const char *text, long low, long high, long *value)
{
    char *end;
    const bool hex = text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
    *value = strtol(text, &end, hex ? 16 : 10);
    return end != text && *end == 0 && *value >= low && *value <= high;
}

bool cli_rc_keys(const char *text, uint16_t *word)
{
    static const char keys[] = "UDLR123456";
    *word = 0;
    if (strcmp(text, "0") == 0) {
        return true;
    }
    for (;; text += 2) {
        const char *key = *text ? strchr(keys, toupper((unsigned char)*text)) : NULL;
        if (key == NULL) {
            return false;
        }
        *word = (uint16_t)(*word | 1u << (key - keys));
        if (text[1] == 0) {
            return true;
        }
        if (text[1] != '+') {
            return false;
        }
    }
}

void cli_rc_packet(uint16_t word, uint8_t packet[CLI_RC_BYTES])
{
    const uint8_t low = (uint8_t)word, high = (uint8_t)(word >> 8);
    packet[0] = 0xFF;
    packet[1] = 0x55;
    packet[2] = low;
    packet[3] = (uint8_t)~low;
    packet[4] = high;
    packet[5] = (uint8_t)~high;
}

static int hex_digit(char c)
{
    return isdigit((unsigned char)c) ? c - '0' : isxdigit((unsigned char)c) ? tolower((unsigned char)c) - 'a' + 10 : -1;
}

/* One escape behind the backslash at *from; -1: no such escape. */
static int escape(const char **from)
{
    static const char names[] = "rnte0\\\"", values[] = "\r\n\t\x1b\0\\\"";
    const char c = *(*from)++;
    if (c == 'x') {
        const int high = hex_digit((*from)[0]), low = high < 0 ? -1 : hex_digit((*from)[1]);
        *from += low < 0 ? 0 : 2;
        return low < 0 ? -1 : high * 16 + low;
    }
    const char *found = c ? strchr(names, c) : NULL;
    return found ? (unsigned char)values[found - names] : -1;
}

/* Quoted text from behind its first quote, unescaped in place. Returns what follows the closing quote, or NULL. */
static char *quoted(char *from, cli_word_t *word, const char **error)
{
    char *to = from;
    *word = (cli_word_t){.text = from, .quoted = true};
    while (*from != '"') {
        int c = (unsigned char)*from;
        if (c == 0) {
            *error = "a closing \" is missing";
            return NULL;
        }
        from++;
        if (c == '\\') {
            const char *behind = from;
            c = escape(&behind);
            if (c < 0) {
                *error = "unknown escape behind \\ (known: \\r \\n \\t \\e \\0 \\\\ \\\" \\xHH)";
                return NULL;
            }
            from += behind - from;
        }
        *to++ = (char)c;
    }
    *to = 0;
    word->length = (size_t)(to - word->text);
    return from + 1;
}

int cli_split(char *line, cli_word_t *words, int max_words, const char **error)
{
    int count = 0;
    for (;;) {
        while (isspace((unsigned char)*line)) {
            line++;
        }
        if (*line == 0 || *line == '#') {
            return count;
        }
        if (count == max_words) {
            *error = "too many words";
            return -1;
        }
        cli_word_t *word = &words[count++];
        if (*line == '"') {
            line = quoted(line + 1, word, error);
            if (line == NULL) {
                return -1;
            }
            continue;
        }
        const size_t length = strcspn(line, " \t\r\n#");
        const bool last = line[length] == 0 || line[length] == '#';
        *word = (cli_word_t){.text = line, .length = length};
        line[length] = 0;
        line += length + (last ? 0 : 1);
        if (last) {
            return count;
        }
    }
}
