/* SPDX-License-Identifier: MIT */
#include "parse.h"

#include <stdbool.h>

static bool is_separator(char c)
{
    return (c >= ' ' && c <= '/') || c == '\t';
}

/* Ends the token at *line with a NUL, in upper case, and moves *line to the next token or the end. */
static char *take_token(char **line)
{
    char *token = *line, *p = token;
    while (*p != 0 && !is_separator(*p)) {
        if (*p >= 'a' && *p <= 'z') {
            *p = (char)(*p - 'a' + 'A');
        }
        p++;
    }
    while (is_separator(*p)) {
        *p++ = 0;
    }
    *line = p;
    return token;
}

/* Returns the number, or a value above PARSE_NUMBER_MAX if it is not valid. */
static uint32_t parse_hex(const char *token)
{
    uint32_t value = 0;
    if (token[0] == '0' && token[1] == 'X') {
        token += 2;
    }
    do {
        uint8_t digit = (uint8_t)(*token - '0');
        if (digit > 9) {
            digit = (uint8_t)(*token - 'A' + 10);
            if (digit < 10 || digit > 15) {
                return PARSE_NUMBER_MAX + 1;
            }
        }
        value = value << 4 | digit;
    } while (*++token != 0 && value <= PARSE_NUMBER_MAX);
    return value;
}

parse_status_t parse_line(char *line, parse_t *parse)
{
    *parse = (parse_t){.arg = {0, 1}};
    while (*line == ' ' || *line == '\t' || *line == '#') {
        line++;
    }
    if (is_separator(*line)) {
        *line = 0;
    }
    parse->word = take_token(&line);
    while (*line != 0) {
        if (parse->count == PARSE_ARGS) {
            return PARSE_ERR_COUNT;
        }
        uint32_t value = parse_hex(take_token(&line));
        if (value > PARSE_NUMBER_MAX) {
            return PARSE_ERR_NUMBER;
        }
        parse->arg[parse->count++] = value;
    }
    return PARSE_OK;
}
