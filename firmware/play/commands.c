/* SPDX-License-Identifier: MIT */
#include "commands.h"

#include <string.h>
#include "commands_motion.h"
#include "pgm.h"
#include "ranges_own.h"
#include "text.h"
#include "views.h"

static uint8_t do_servos(const shell_args_t *args)
{
    if (args->count == 1) {
        views_print_servos();
        return REQUEST_OK;
    }
    if (!shell_word_is(args, 1, PSTR("find"))) {
        return requests_refuse(REQUEST_ERR_RANGE, TEXT_P("Say servos, or servos find"));
    }
    if (!performer_is_still(&the_play.performer)) {
        return SHELL_ERR_MOVING;
    }
    play_find_servos();
    views_print_servos_found();
    return REQUEST_OK;
}

/* ---- law, remote, settings: kept in EEPROM ---- */

static void save(void)
{
    settings_save_start(&the_play.store);
}

/* Sets 0, 1, ... by one of several words (settings_word_P). Prints the current word if the line has none. */
static uint8_t choose(const shell_args_t *args, uint8_t *setting, const char *words_P, const char *refusal_P)
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
            save();
            return REQUEST_OK;
        }
    }
    return requests_refuse(REQUEST_ERR_RANGE, refusal_P);
}

static uint8_t do_law(const shell_args_t *args)
{
    return choose(args, &the_play.store.settings.law, settings_laws_P, TEXT_P("Say exact or classic"));
}

static uint8_t do_remote(const shell_args_t *args)
{
    return choose(args, &the_play.store.settings.remote_mode, settings_remotes_P, TEXT_P("Say latch or hold or drive"));
}

static uint8_t set_one(const shell_args_t *args)
{
    for (uint8_t i = 0; i < SETTINGS_ITEMS; i++) {
        settings_item_t item;
        settings_item(i, &item);
        if (shell_word_is(args, 1, item.name)) {
            uint16_t value;
            if (!shell_parse(shell_word(args, 2), false, &value) || !settings_set(&the_play.store.settings, &item, value)) {
                shell_print_range(item.name, item.low, item.high, false);
                return SHELL_ERR_REPORTED;
            }
            save();
            return REQUEST_OK;
        }
    }
    TEXT("No setting is named ");
    text_string(shell_word(args, 1));
    return SHELL_ERR_REPORTED;
}

static uint8_t do_settings(const shell_args_t *args)
{
    if (args->count == 3) {
        return set_one(args);
    }
    if (args->count == 2) {
        if (!shell_word_is(args, 1, PSTR("defaults"))) {
            TEXT("Say settings, settings name value, or settings defaults");
            return SHELL_ERR_REPORTED;
        }
        settings_defaults(&the_play.store.settings);
        save();
        return REQUEST_OK;
    }
    views_print_settings();
    return REQUEST_OK;
}

/* ---- the tables, help ---- */

static uint8_t do_help(const shell_args_t *args);

TEXT_NAMED(word_play, "play p n|name  plays a page");
TEXT_NAMED(word_stop, "stop s through the exit page; twice within a second: break");
TEXT_NAMED(word_break, "break b ends now: slows down and holds");
TEXT_NAMED(word_pause, "pause  slows down and holds until resume");
TEXT_NAMED(word_resume, "resume  goes on after pause");
TEXT_NAMED(word_rate, "rate  percent  speed of the motion, 10..400");
TEXT_NAMED(word_amplitude, "amplitude  percent [id ...]  size of the motion, 0..150");
TEXT_NAMED(word_blend, "blend  percent  towards the partner page: left -100..100 right");
TEXT_NAMED(word_drive, "drive  blend rate amplitude  all three, again and again");
TEXT_NAMED(word_layer, "layer  n [id ...]|off  a second page, on joints of its own");
TEXT_NAMED(word_aim, "aim  id position [degrees/s]  moves a joint by itself; up to four");
TEXT_NAMED(word_swing, "swing  id centre amplitude ms [phase]  likewise, to and fro");
TEXT_NAMED(word_free, "free  [id ...]  ends aim and swing");
TEXT_NAMED(word_shape, "shape  [reset]  what of this is in force");

static const shell_command_t shared[] PROGMEM = {
    { word_play, commands_do_play, SHELL_ARGS(1, 7), 0 },
    { word_stop, commands_do_stop, SHELL_ARGS(0, 0), 0 },
    { word_break, commands_do_break, SHELL_ARGS(0, 0), 0 },
    { word_pause, commands_do_pause, SHELL_ARGS(0, 0), 0 },
    { word_resume, commands_do_resume, SHELL_ARGS(0, 0), 0 },
    { word_rate, commands_do_rate, SHELL_ARGS(1, 1), RANGE_RATE },
    { word_amplitude, commands_do_amplitude, SHELL_ARGS(1, SHELL_ANY_ARGS), RANGE_AMPLITUDE },
    { word_blend, commands_do_blend, SHELL_ARGS(1, 1), RANGE_BLEND },
    { word_drive, commands_do_drive, SHELL_ARGS(3, 3), SHELL_BOTH(RANGE_BLEND, RANGE_RATE) },
    { word_layer, commands_do_layer, SHELL_ARGS(1, SHELL_ANY_ARGS), 0 },
    { word_aim, commands_do_aim, SHELL_ARGS(2, 3), SHELL_BOTH(RANGE_ID, RANGE_POSITION) },
    { word_swing, commands_do_swing, SHELL_ARGS(4, 5), SHELL_BOTH(RANGE_ID, RANGE_POSITION) },
    { word_free, commands_do_free, SHELL_ARGS(0, SHELL_ANY_ARGS), 0 },
    { word_shape, commands_do_shape, SHELL_ARGS(0, 1), 0 },
};
const requests_table_t commands_shared = { shared, ARRAY_COUNT(shared) };

TEXT_NAMED(word_code, "code  n  a code 0..255, as from the remote");
TEXT_NAMED(word_on, "on  [id ...]  torque on, holding the pose");
TEXT_NAMED(word_off, "off  [id ...]  torque off");
TEXT_NAMED(word_list, "list  the pages that are not empty");
TEXT_NAMED(word_status, "status  what is playing");
TEXT_NAMED(word_servos, "servos  [find]  the servos; or searches again");
TEXT_NAMED(word_faults, "faults  of servos, bus, serial line and ticks");
TEXT_NAMED(word_law, "law  [exact|classic]  the law of motion, kept");
TEXT_NAMED(word_remote, "remote  [latch|hold|drive]  letting go: goes on, or stops; L and R steer; kept");
TEXT_NAMED(word_settings, "settings  [name value|defaults]  what is kept");
TEXT_NAMED(word_version, "version  of this program");
TEXT_NAMED(word_help, "help ? [word]  this list");

static const shell_command_t typed[] PROGMEM = {
    { word_code, commands_do_code, SHELL_ARGS(1, 1), RANGE_ANY_CODE },
    { word_on, request_on, SHELL_ARGS(0, SHELL_ANY_ARGS), 0 },
    { word_off, request_off, SHELL_ARGS(0, SHELL_ANY_ARGS), 0 },
    { word_list, views_list, SHELL_ARGS(0, 0), 0 },
    { word_status, views_status, SHELL_ARGS(0, 0), 0 },
    { word_servos, do_servos, SHELL_ARGS(0, 1), 0 },
    { word_faults, views_faults, SHELL_ARGS(0, 0), 0 },
    { word_law, do_law, SHELL_ARGS(0, 1), 0 },
    { word_remote, do_remote, SHELL_ARGS(0, 1), 0 },
    { word_settings, do_settings, SHELL_ARGS(0, 2), 0 },
    { word_version, views_version, SHELL_ARGS(0, 0), 0 },
    { word_help, do_help, SHELL_ARGS(0, 1), 0 },
};

static void print_help(const shell_command_t *table_P, uint8_t count)
{
    for (; count > 0; count--) {
        shell_print_help(table_P++);
    }
}

static uint8_t do_help(const shell_args_t *args)
{
    if (args->count == 2) {
        const shell_command_t *command = shell_find(shared, ARRAY_COUNT(shared), args, 1);
        command = command != NULL ? command : shell_find(typed, ARRAY_COUNT(typed), args, 1);
        if (command == NULL) {
            return SHELL_ERR_UNKNOWN;
        }
        shell_print_help(command);
        return REQUEST_OK;
    }
    print_help(shared, ARRAY_COUNT(shared));
    print_help(typed, ARRAY_COUNT(typed));
    return REQUEST_OK;
}

bool commands_run(void)
{
    shell_args_t args;
    shell_split(&the_play.shell, false, &args);
    return args.count == 0 || requests_run_typed(&args, typed, ARRAY_COUNT(typed));
}
