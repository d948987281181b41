/* SPDX-License-Identifier: MIT
 * commands_settings.c - what is kept over power-off. */
#include "commands_parts.h"

#include "text.h"
#include "views.h"

static void save(play_t *play)
{
    settings_save_start(&play->store);
}

/* One of two words for a setting of 0 and 1; prints the choice when there is no word. */
static uint8_t choose(play_t *play, const shell_args_t *args, uint8_t *setting, const char *zero_P, const char *one_P)
{
    if (args->count == 1) {
        text_P(*setting == 0 ? zero_P : one_P);
        text_line_end();
        return SHELL_OK;
    }
    if (!shell_word_is(args, 1, zero_P) && !shell_word_is(args, 1, one_P)) {
        TEXT("Say ");
        text_P(zero_P);
        TEXT(" or ");
        text_P(one_P);
        return SHELL_ERR_SAID;
    }
    *setting = shell_word_is(args, 1, one_P) ? 1 : 0;
    save(play);
    return SHELL_OK;
}

uint8_t commands_do_law(void *context, const shell_args_t *args)
{
    play_t *play = context;
    return choose(play, args, &play->settings.law, PSTR("exact"), PSTR("classic"));
}

uint8_t commands_do_remote(void *context, const shell_args_t *args)
{
    play_t *play = context;
    return choose(play, args, &play->settings.remote_mode, PSTR("latch"), PSTR("hold"));
}

static uint8_t set_one(play_t *play, const shell_args_t *args)
{
    for (uint8_t i = 0; i < SETTINGS_ITEMS; i++) {
        settings_item_t item;
        settings_item(i, &item);
        if (shell_word_is(args, 1, item.name)) {
            uint16_t value;
            if (!shell_number(args, 2, item.name, item.low, item.high, &value) ||
                !settings_set(&play->settings, &item, value)) {
                return SHELL_ERR_SAID;
            }
            save(play);
            return SHELL_OK;
        }
    }
    TEXT("No setting is named ");
    text_string(shell_word(args, 1));
    return SHELL_ERR_SAID;
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
            return SHELL_ERR_SAID;
        }
        settings_defaults(&play->settings);
        save(play);
        return SHELL_OK;
    }
    views_print_settings(play);
    return SHELL_OK;
}
