/* SPDX-License-Identifier: MIT
 * commands_settings.c - law, remote, settings: what EEPROM keeps. */
#include "commands_parts.h"

#include <string.h>
#include "pgm.h"
#include "text.h"
#include "views.h"

static void save(play_t *play)
{
    settings_save_start(&play->store);
}

/* Sets 0, 1, ... by one of several words (settings_word_P). Prints the present word if the line has none. */
static uint8_t choose(play_t *play, const shell_args_t *args, uint8_t *setting, const char *words_P)
{
    const char *word_P;
    if (args->count == 1) {
        text_P(settings_word_P(words_P, *setting));
        text_line_end();
        return REQUEST_OK;
    }
    for (uint8_t value = 0; pgm_read_byte(word_P = settings_word_P(words_P, value)) != '\0'; value++) {
        if (shell_word_is(args, 1, word_P)) {
            *setting = value;
            save(play);
            return REQUEST_OK;
        }
    }
    TEXT("Say ");
    for (word_P = words_P; pgm_read_byte(word_P) != '\0'; word_P = settings_word_P(word_P, 1)) {
        if (word_P != words_P) {
            TEXT(" or ");
        }
        text_P(word_P);
    }
    return SHELL_ERR_REPORTED;
}

uint8_t commands_do_law(void *context, const shell_args_t *args)
{
    play_t *play = context;
    return choose(play, args, &play->settings.law, settings_laws_P);
}

uint8_t commands_do_remote(void *context, const shell_args_t *args)
{
    play_t *play = context;
    return choose(play, args, &play->settings.remote_mode, settings_remotes_P);
}

static uint8_t set_one(play_t *play, const shell_args_t *args)
{
    for (uint8_t i = 0; i < SETTINGS_ITEMS; i++) {
        settings_item_t item;
        settings_item(i, &item);
        if (shell_word_is(args, 1, item.name)) {
            uint16_t value;
            if (!shell_parse(shell_word(args, 2), false, &value) || !settings_set(&play->settings, &item, value)) {
                shell_print_range(item.name, item.range.low, item.range.high, false);
                return SHELL_ERR_REPORTED;
            }
            save(play);
            return REQUEST_OK;
        }
    }
    TEXT("No setting is named ");
    text_string(shell_word(args, 1));
    return SHELL_ERR_REPORTED;
}

uint8_t commands_do_settings(void *context, const shell_args_t *args)
{
    play_t *play = context;
    if (args->count == 3) {
        return set_one(play, args);
    }
    if (args->count == 2) {
        if (!shell_word_is(args, 1, PSTR("defaults"))) {
            TEXT("Say settings, settings name value, or settings defaults");
            return SHELL_ERR_REPORTED;
        }
        settings_defaults(&play->settings);
        save(play);
        return REQUEST_OK;
    }
    views_print_settings(play);
    return REQUEST_OK;
}
