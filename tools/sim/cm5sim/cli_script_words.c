/* SPDX-License-Identifier: MIT */
#include "cli_script_words.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define DEFAULT_WITHIN (1000u * (uint64_t)BOARD_CYCLES_PER_MS)

cli_word_t *take(rest_t *rest, bool quoted, const char *what)
{
    if (rest->count == 0 || rest->words->quoted != quoted) {
        rest->error = rest->error ? rest->error : what;
        return NULL;
    }
    rest->count--;
    return rest->words++;
}

bool take_if(rest_t *rest, const char *word)
{
    if (rest->count == 0 || rest->words->quoted || strcmp(rest->words->text, word) != 0) {
        return false;
    }
    rest->words++;
    rest->count--;
    return true;
}

void take_text(rest_t *rest, command_t *command, const char *what)
{
    const cli_word_t *word = take(rest, true, what);
    if (word) {
        command->length = word->length;
        command->text = malloc(word->length + 1);
        memcpy(command->text, word->text, word->length + 1);
    }
}

void take_duration(rest_t *rest, uint64_t *cycles)
{
    static const char what[] = "a time like 500ms or 2s is missing here";
    const cli_word_t *word = take(rest, false, what);
    if (word && !cli_duration(word->text, cycles)) {
        rest->error = what;
    }
}

void take_number(rest_t *rest, long low, long high, long *value, const char *what)
{
    const cli_word_t *word = take(rest, false, what);
    if (word && !cli_number(word->text, low, high, value)) {
        rest->error = what;
    }
}

void take_real(rest_t *rest, double low, double high, double *value, const char *what)
{
    const cli_word_t *word = take(rest, false, what);
    char *end = NULL;
    if (word) {
        *value = strtod(word->text, &end);
        if (end == word->text || *end || *value < low || *value > high) {
            rest->error = what;
        }
    }
}

void take_name(rest_t *rest, const char *const *names, int count, long *index, const char *what)
{
    const cli_word_t *word = take(rest, false, what);
    for (int i = 0; word && i < count; i++) {
        if (strcasecmp(names[i], word->text) == 0) {
            *index = i;
            return;
        }
    }
    rest->error = what;
}

void take_on_off(rest_t *rest, bool *on)
{
    static const char *const names[] = {"off", "on"};
    long index = 0;
    take_name(rest, names, 2, &index, "on or off is missing here");
    *on = index == 1;
}

void take_within(rest_t *rest, command_t *command)
{
    command->cycles = DEFAULT_WITHIN;
    if (take_if(rest, "within")) {
        take_duration(rest, &command->cycles);
    }
}
