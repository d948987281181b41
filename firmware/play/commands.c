/* SPDX-License-Identifier: MIT */
#include "commands.h"

#include "commands_parts.h"
#include "report.h"
#include "text.h"
#include "views.h"

/* ---- playing ---- */

uint8_t commands_refuse(performer_status_t status, uint8_t page, uint8_t fault)
{
    report_refusal(status, page, fault);
    return status == PERFORMER_OK ? SHELL_OK : SHELL_ERR_SAID;
}

/* The page that a word names, by number or by name; 0: there is none, and it has been said. */
static uint8_t page_of_word(const play_t *play, const shell_args_t *args)
{
    uint16_t number;
    const char *word = shell_word(args, 1);
    if (word[0] >= '0' && word[0] <= '9') {
        return shell_number(args, 1, TEXT_P("Page"), 1, PAGE_COUNT - 1, &number) ? (uint8_t)number : 0;
    }
    /* A name may hold separators: the words are put together again with a space between. */
    char name[PAGE_NAME_BYTES];
    uint8_t length = 0;
    for (uint8_t i = 1; i < args->count; i++) {
        for (word = shell_word(args, i); *word != '\0' && length < sizeof name - 1; word++) {
            name[length++] = *word;
        }
        if (i + 1u < args->count && length < sizeof name - 1) {
            name[length++] = ' ';
        }
    }
    name[length] = '\0';
    const uint8_t page = page_store_find(&play->pages, name, 0);
    if (page == 0) {
        TEXT("No page is named ");
        text_string(name);
    }
    return page;
}

static uint8_t do_play(void *context, const shell_args_t *args)
{
    play_t *play = context;
    const uint8_t page = page_of_word(play, args);
    if (page == 0) {
        return SHELL_ERR_SAID;
    }
    const performer_status_t status = performer_start(&play->performer, page, LINK_CODE_NONE);
    return commands_refuse(status, play->performer.fault_page, play->performer.fault);
}

static uint8_t nothing_is_playing(void)
{
    TEXT("Nothing is playing");
    return SHELL_ERR_SAID;
}

static uint8_t do_stop(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)args;
    if (performer_is_idle(&play->performer)) {
        return nothing_is_playing();
    }
    performer_stop(&play->performer);
    return SHELL_OK;
}

static uint8_t do_break(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)args;
    if (performer_is_idle(&play->performer)) {
        return nothing_is_playing();
    }
    performer_break(&play->performer);
    return SHELL_OK;
}

static uint8_t do_pause(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)args;
    if (performer_is_idle(&play->performer)) {
        return nothing_is_playing();
    }
    if (!performer_pause(&play->performer)) {
        TEXT("Cannot pause now");
        return SHELL_ERR_SAID;
    }
    return SHELL_OK;
}

static uint8_t do_resume(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)args;
    if (!performer_resume(&play->performer)) {
        TEXT("Nothing is paused");
        return SHELL_ERR_SAID;
    }
    return SHELL_OK;
}

/* The same as the remote: for boards without a panel. */
static uint8_t do_code(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint16_t code;
    inputs_refusal_t refusal;
    if (!shell_number(args, 1, TEXT_P("Code"), 0, 255, &code)) {
        return SHELL_ERR_SAID;
    }
    inputs_code(&play->inputs, (uint8_t)code);
    if (!inputs_next_refusal(&play->inputs, &refusal)) {
        return SHELL_OK;
    }
    views_print_refusal(&refusal);
    return SHELL_ERR_SAID;
}

/* ---- to look at ---- */

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

TEXT_NAMED(help_baud, "[id ...]  moves slow servos to 1 Mbps");
TEXT_NAMED(help_break, "ends now: slows down and holds");
TEXT_NAMED(help_code, "n  a code 0..255, as from the remote");
TEXT_NAMED(help_faults, "servos, bus, serial line and ticks: what went wrong");
TEXT_NAMED(help_help, "[word]  this list");
TEXT_NAMED(help_law, "[exact|classic]  the law of motion");
TEXT_NAMED(help_list, "the pages that are not empty");
TEXT_NAMED(help_off, "[id ...]  torque off");
TEXT_NAMED(help_on, "[id ...]  torque on, holding the pose");
TEXT_NAMED(help_pause, "slows down and holds until resume");
TEXT_NAMED(help_play, "n|name  plays a page");
TEXT_NAMED(help_remote, "[latch|hold]  letting go of the buttons: goes on, or stops");
TEXT_NAMED(help_resume, "goes on after pause");
TEXT_NAMED(help_servos, "[find]  the servos; or searches again");
TEXT_NAMED(help_settings, "[name value|defaults]");
TEXT_NAMED(help_status, "what is playing");
TEXT_NAMED(help_stop, "ends softly, through the exit page; twice within a second: break");
TEXT_NAMED(help_version, "of this program");

static const shell_command_t table[] PROGMEM = {
    {"play", "p", 1, 6, do_play, help_play},
    {"stop", "s", 0, 0, do_stop, help_stop},
    {"break", "b", 0, 0, do_break, help_break},
    {"pause", "", 0, 0, do_pause, help_pause},
    {"resume", "", 0, 0, do_resume, help_resume},
    {"code", "", 1, 1, do_code, help_code},
    {"on", "", 0, SHELL_ANY_ARGS, commands_do_on, help_on},
    {"off", "", 0, SHELL_ANY_ARGS, commands_do_off, help_off},
    {"list", "", 0, 0, do_list, help_list},
    {"status", "", 0, 0, do_status, help_status},
    {"servos", "", 0, 1, commands_do_servos, help_servos},
    {"faults", "", 0, 0, do_faults, help_faults},
    {"law", "", 0, 1, commands_do_law, help_law},
    {"remote", "", 0, 1, commands_do_remote, help_remote},
    {"settings", "", 0, 2, commands_do_settings, help_settings},
    {"baud", "", 0, SHELL_ANY_ARGS, commands_do_baud, help_baud},
    {"version", "", 0, 0, do_version, help_version},
    {"help", "?", 0, 1, do_help, help_help},
};

static uint8_t do_help(void *context, const shell_args_t *args)
{
    (void)context;
    if (args->count == 2) {
        const shell_command_t *command = shell_find(table, ARRAY_COUNT(table), args, 1);
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
    return SHELL_OK;
}

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
    default:
        break;
    }
    text_line_end();
}

void commands_run(play_t *play)
{
    const shell_args_t args = shell_split(&play->shell, false);
    if (machine_is_for(&args)) {
        (void)machine_run(&play->machine, &args);
    } else if (args.count > 0) {
        answer(shell_run(table, ARRAY_COUNT(table), play, &args), &args);
    }
}
