/* SPDX-License-Identifier: MIT */
#include "commands.h"

#include "commands_parts.h"
#include "text.h"
#include "views.h"

static uint8_t do_list(void *context, const shell_args_t *args)
{
    (void)args;
    views_print_list(context);
    return SHELL_OK;
}

static uint8_t do_status(void *context, const shell_args_t *args)
{
    (void)args;
    views_print_status(context);
    return SHELL_OK;
}

static uint8_t do_faults(void *context, const shell_args_t *args)
{
    (void)args;
    views_print_faults(context);
    return SHELL_OK;
}

static uint8_t do_version(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    views_print_version();
    return SHELL_OK;
}

static uint8_t do_help(void *context, const shell_args_t *args);

TEXT_NAMED(word_play, "play p n|name  plays a page");
TEXT_NAMED(word_stop, "stop s ends softly, through the exit page; twice within a second: break");
TEXT_NAMED(word_break, "break b ends now: slows down and holds");
TEXT_NAMED(word_pause, "pause  slows down and holds until resume");
TEXT_NAMED(word_resume, "resume  goes on after pause");
TEXT_NAMED(word_code, "code  n  a code 0..255, as from the remote");
TEXT_NAMED(word_on, "on  [id ...]  torque on, holding the pose");
TEXT_NAMED(word_off, "off  [id ...]  torque off");
TEXT_NAMED(word_list, "list  the pages that are not empty");
TEXT_NAMED(word_status, "status  what is playing");
TEXT_NAMED(word_servos, "servos  [find]  the servos; or searches again");
TEXT_NAMED(word_faults, "faults  servos, bus, serial line and ticks: what went wrong");
TEXT_NAMED(word_law, "law  [exact|classic]  the law of motion");
TEXT_NAMED(word_remote, "remote  [latch|hold|drive]  letting go: goes on, or stops; L and R steer");
TEXT_NAMED(word_settings, "settings  [name value|defaults]");
TEXT_NAMED(word_baud, "baud  [id ...]  moves slow servos to 1 Mbps");
TEXT_NAMED(word_version, "version  of this program");
TEXT_NAMED(word_help, "help ? [word]  this list");

static const shell_command_t table[] PROGMEM = {
    { word_play, commands_do_play, SHELL_ARGS(1, 6), 0 },
    { word_stop, commands_do_stop, SHELL_ARGS(0, 0), 0 },
    { word_break, commands_do_break, SHELL_ARGS(0, 0), 0 },
    { word_pause, commands_do_pause, SHELL_ARGS(0, 0), 0 },
    { word_resume, commands_do_resume, SHELL_ARGS(0, 0), 0 },
    { word_code, commands_do_code, SHELL_ARGS(1, 1), 0 },
    { word_on, commands_do_on, SHELL_ARGS(0, SHELL_ANY_ARGS), 0 },
    { word_off, commands_do_off, SHELL_ARGS(0, SHELL_ANY_ARGS), 0 },
    { word_list, do_list, SHELL_ARGS(0, 0), 0 },
    { word_status, do_status, SHELL_ARGS(0, 0), 0 },
    { word_servos, commands_do_servos, SHELL_ARGS(0, 1), 0 },
    { word_faults, do_faults, SHELL_ARGS(0, 0), 0 },
    { word_law, commands_do_law, SHELL_ARGS(0, 1), 0 },
    { word_remote, commands_do_remote, SHELL_ARGS(0, 1), 0 },
    { word_settings, commands_do_settings, SHELL_ARGS(0, 2), 0 },
    { word_baud, commands_do_baud, SHELL_ARGS(0, SHELL_ANY_ARGS) | SHELL_STILL, 0 },
    { word_version, do_version, SHELL_ARGS(0, 0), 0 },
    { word_help, do_help, SHELL_ARGS(0, 1), 0 },
};

/* Both tables: words of Play, and those that programs may use too. */
static const shell_command_t *find(const shell_args_t *args, uint8_t index)
{
    const shell_command_t *command = shell_find(table, ARRAY_COUNT(table), args, index);
    return command != NULL ? command : shell_find(commands_shape_table, COMMANDS_SHAPE_COUNT, args, index);
}

static uint8_t do_help(void *context, const shell_args_t *args)
{
    (void)context;
    if (args->count == 2) {
        const shell_command_t *command = find(args, 1);
        if (command == NULL) {
            TEXT("Unknown word ");
            text_string(shell_word(args, 1));
            return SHELL_ERR_SAID;
        }
        shell_print_help(command);
        return SHELL_OK;
    }
    for (uint8_t i = 0; i < ARRAY_COUNT(table); i++) {
        shell_print_help(&table[i]);
    }
    for (uint8_t i = 0; i < COMMANDS_SHAPE_COUNT; i++) {
        shell_print_help(&commands_shape_table[i]);
    }
    return SHELL_OK;
}

static uint8_t not_in_this_image(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    return REQUEST_ERR_IMAGE;
}

TEXT_NAMED(word_open, "@open  ");
TEXT_NAMED(word_data, "@data  ");
TEXT_NAMED(word_crc, "@crc  ");
TEXT_NAMED(word_save, "@save  ");
const shell_command_t commands_requests_P[COMMANDS_REQUESTS] PROGMEM = {
    { word_open, not_in_this_image, SHELL_ARGS(0, SHELL_ANY_ARGS), 0 },
    { word_data, not_in_this_image, SHELL_ARGS(0, SHELL_ANY_ARGS), 0 },
    { word_crc, not_in_this_image, SHELL_ARGS(0, SHELL_ANY_ARGS), 0 },
    { word_save, not_in_this_image, SHELL_ARGS(0, SHELL_ANY_ARGS), 0 },
};

static void answer(uint8_t status, const shell_args_t *args)
{
    switch (status) {
    case SHELL_OK:
        TEXT(" OK");
        break;
    case SHELL_ERR_UNKNOWN:
        TEXT("Unknown word ");
        text_string(shell_word(args, 0));
        TEXT(": try help");
        break;
    case SHELL_ERR_COUNT:
        TEXT("Too few or too many words: try help ");
        text_string(shell_word(args, 0));
        break;
    case SHELL_ERR_MOVING:
        (void)commands_refuse(PERFORMER_ERR_BUSY, 0, 0);
        break;
    default:
        break;
    }
    text_line_end();
}

void commands_run(play_t *play)
{
    shell_args_t args = shell_split(&play->shell, false);
    if (requests_are(&args)) {
        requests_run(&args);
    } else if (args.count > 0) {
        const bool moving = !performer_is_still(&play->performer);
        uint8_t status = shell_run(table, ARRAY_COUNT(table), play, &args, moving);
        if (status == SHELL_ERR_UNKNOWN) {
            status = shell_run(commands_shape_table, COMMANDS_SHAPE_COUNT, play, &args, moving);
        }
        answer(status, &args);
    }
}
