/* SPDX-License-Identifier: MIT
 * cli_script_words.h - takes a script line apart, word by word. For cli_script.c only. The first thing that is wrong
 * stays in rest->error; what is taken behind it does no harm. */
#ifndef CLI_SCRIPT_WORDS_H
#define CLI_SCRIPT_WORDS_H

#include "cli_script.h"

/* The words of a line not used up yet. */
typedef struct {
    cli_word_t *words;
    int count;
    const char *error;
} rest_t;

/* Takes the next word; NULL with the error `what` when there is none or it is (not) quoted against our wish. */
cli_word_t *take(rest_t *rest, bool quoted, const char *what);

/* Takes the next word if it is this one. */
bool take_if(rest_t *rest, const char *word);

/* Takes a "text" into command->text and length; the command owns it. */
void take_text(rest_t *rest, command_t *command, const char *what);

/* Takes a time, a number in low..high, one of names (by index), on or off. */
void take_duration(rest_t *rest, uint64_t *cycles);
void take_number(rest_t *rest, long low, long high, long *value, const char *what);
void take_real(rest_t *rest, double low, double high, double *value, const char *what);
void take_name(rest_t *rest, const char *const *names, int count, long *index, const char *what);
void take_on_off(rest_t *rest, bool *on);

/* Takes `within T` into command->cycles if it is there: 1 s otherwise. */
void take_within(rest_t *rest, command_t *command);

#endif
