/* SPDX-License-Identifier: MIT
 * shell.c - finds the command of a line in a table, checks its arguments, and calls its handler. */
#include "shell.h"

#include <stddef.h>
#include <string.h>
#include "compiler.h"
#include "text.h"

/* Reads up to the next space. true: the characters before it are `word`. */
static bool field_is(text_reader_t *reader, const char *word)
{
    uint8_t differs = 0;
    for (char character; (character = text_next(reader)) != ' ';) {
        const char typed = *word >= 'A' && *word <= 'Z' ? *word | 0x20 : *word;
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

/* Parses the first two words after the command if `ranges` has ranges for them. false: out of range. */
static bool take_numbers(shell_args_t *args, uint16_t ranges)
{
    for (uint8_t i = 0; i < ARRAY_COUNT(args->number); i++, ranges >>= 8) {
        args->number[i] = 0;
        if ((uint8_t)ranges != 0 && i + 1 < args->count &&
            !shell_take(args, i + 1u, (uint8_t)ranges, &args->number[i])) {
            return false;
        }
    }
    return true;
}

uint8_t shell_run(const shell_command_t *table_P, uint8_t count, shell_args_t *args, bool moving)
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
    const uint8_t given = args->count - 1, most = found.args & 0x0Fu;
    if (given < (found.args >> 4 & 7u) || (given > most && most != SHELL_ANY_ARGS)) {
        return SHELL_ERR_COUNT;
    }
    if (moving && (found.args & SHELL_STILL) != 0) {
        return SHELL_ERR_MOVING;
    }
    if (!take_numbers(args, found.numbers)) {
        return SHELL_ERR_RANGE;
    }
    return found.handler(args);
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
