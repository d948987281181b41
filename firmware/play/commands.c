/* SPDX-License-Identifier: MIT */
#include "commands.h"

#include <string.h>
#include "board.h"
#include "report.h"
#include "text.h"
#include "views.h"

#define ID_MAX (SERVO_LINK_JOINTS - 1u)

/* ---- playing ---- */

static uint8_t refuse(performer_status_t status, uint8_t page, uint8_t fault)
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
        return shell_number(args, 1, PSTR("Page"), 1, PAGE_COUNT - 1, &number) ? (uint8_t)number : 0;
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
    return refuse(status, page, play->performer.fault);
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
    if (!shell_number(args, 1, PSTR("Code"), 0, 255, &code)) {
        return SHELL_ERR_SAID;
    }
    inputs_code(&play->inputs, (uint8_t)code);
    if (!inputs_next_refusal(&play->inputs, &refusal)) {
        return SHELL_OK;
    }
    views_print_refusal(&refusal);
    return SHELL_ERR_SAID;
}

static uint8_t do_approach(void *context, const shell_args_t *args)
{
    play_t *play = context;
    if (!performer_is_idle(&play->performer)) {
        return refuse(PERFORMER_ERR_BUSY, 0, 0);
    }
    if (shell_word_is(args, 1, PSTR("on"))) {
        play->performer.approach_off = false;
    } else if (shell_word_is(args, 1, PSTR("off"))) {
        play->performer.approach_off = true;
    } else {
        TEXT("Say on or off");
        return SHELL_ERR_SAID;
    }
    return SHELL_OK;
}

/* ---- servos ---- */

/* The joints named from word `first` on, all that are present when there is no word. false: said what is wrong. */
static bool joints_of_words(const play_t *play, const shell_args_t *args, uint8_t first, uint32_t *joints)
{
    *joints = args->count <= first ? play->servos.present : 0;
    for (uint8_t i = first; i < args->count; i++) {
        uint16_t id;
        if (!shell_number(args, i, PSTR("ID"), 0, ID_MAX, &id)) {
            return false;
        }
        if ((play->servos.present & SERVO_LINK_BIT(id)) == 0) {
            TEXT("Servo ");
            text_number(id);
            TEXT(" is not there");
            return false;
        }
        *joints |= SERVO_LINK_BIT(id);
    }
    if (*joints == 0) {
        return refuse(PERFORMER_ERR_NO_SERVOS, 0, 0) == SHELL_OK;
    }
    return true;
}

static uint8_t do_on(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint32_t joints;
    if (!joints_of_words(play, args, 1, &joints)) {
        return SHELL_ERR_SAID;
    }
    if (!performer_is_idle(&play->performer)) {
        return refuse(PERFORMER_ERR_BUSY, 0, 0);
    }
    uint32_t failed = 0;
    for (uint8_t id = 0; id <= ID_MAX; id++) {
        if ((joints & SERVO_LINK_BIT(id)) != 0 && performer_is_idle(&play->performer)) {
            failed |= SERVO_LINK_BIT(id) & ~performer_on(&play->performer, SERVO_LINK_BIT(id));
            play_service(play);
        }
    }
    if (failed != 0) {
        TEXT("No answer from servos ");
        report_joints(failed);
        return SHELL_ERR_SAID;
    }
    return SHELL_OK;
}

static uint8_t do_off(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint32_t joints;
    if (!joints_of_words(play, args, 1, &joints)) {
        return SHELL_ERR_SAID;
    }
    performer_off(&play->performer, joints);
    return SHELL_OK;
}

static uint8_t do_servos(void *context, const shell_args_t *args)
{
    play_t *play = context;
    if (args->count > 1 && !shell_word_is(args, 1, PSTR("find"))) {
        TEXT("Say servos, or servos find to search again");
        return SHELL_ERR_SAID;
    }
    if (args->count > 1) {
        if (!performer_is_idle(&play->performer)) {
            return refuse(PERFORMER_ERR_BUSY, 0, 0);
        }
        play_find_servos(play);
        views_print_servos_found(play);
        return SHELL_OK;
    }
    views_print_servos(play);
    return SHELL_OK;
}

static uint8_t do_baud(void *context, const shell_args_t *args)
{
    play_t *play = context;
    if (!performer_is_idle(&play->performer)) {
        return refuse(PERFORMER_ERR_BUSY, 0, 0);
    }
    uint32_t joints = args->count == 1 ? play->servos.slow : 0;
    for (uint8_t i = 1; i < args->count; i++) {
        uint16_t id;
        if (!shell_number(args, i, PSTR("ID"), 0, ID_MAX, &id)) {
            return SHELL_ERR_SAID;
        }
        joints |= SERVO_LINK_BIT(id);
    }
    if ((joints & play->servos.slow) != joints || joints == 0) {
        TEXT("Servos at 57142 bps: ");
        report_joints(play->servos.slow);
        return SHELL_ERR_SAID;
    }
    const uint32_t moved = servo_link_fast_baud(&play->servos, joints);
    TEXT("Moved to 1 Mbps: ");
    report_joints(moved);
    text_line_end();
    views_print_servos_found(play);
    return SHELL_OK;
}

/* ---- settings ---- */

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

static uint8_t do_law(void *context, const shell_args_t *args)
{
    play_t *play = context;
    return choose(play, args, &play->settings.law, PSTR("exact"), PSTR("classic"));
}

static uint8_t do_remote(void *context, const shell_args_t *args)
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

static uint8_t do_settings(void *context, const shell_args_t *args)
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

#define HELP(name, text) static const char help_##name[] PROGMEM = text
HELP(approach, "on|off  the way to the first pose; off only to compare recorded traces");
HELP(baud, "[id ...]  moves slow servos to 1 Mbps");
HELP(break, "ends now: slows down and holds");
HELP(code, "n  a code 0..255, as from the remote");
HELP(faults, "servos, bus, serial line and ticks: what went wrong");
HELP(help, "[word]  this list");
HELP(law, "[exact|classic]  the law of motion");
HELP(list, "the pages that are not empty");
HELP(off, "[id ...]  torque off");
HELP(on, "[id ...]  torque on, holding the pose");
HELP(pause, "slows down and holds until resume");
HELP(play, "n|name  plays a page");
HELP(remote, "[latch|hold]  letting go of the buttons: goes on, or stops");
HELP(resume, "goes on after pause");
HELP(servos, "[find]  the servos; or searches again");
HELP(settings, "[name value|defaults]");
HELP(status, "what is playing");
HELP(stop, "ends softly, through the exit page; twice within a second: break");
HELP(version, "of this program");

static const shell_command_t table[] PROGMEM = {
    {"play", "p", 1, 6, do_play, help_play},
    {"stop", "s", 0, 0, do_stop, help_stop},
    {"break", "b", 0, 0, do_break, help_break},
    {"pause", "", 0, 0, do_pause, help_pause},
    {"resume", "", 0, 0, do_resume, help_resume},
    {"code", "", 1, 1, do_code, help_code},
    {"on", "", 0, SHELL_ANY_ARGS, do_on, help_on},
    {"off", "", 0, SHELL_ANY_ARGS, do_off, help_off},
    {"list", "", 0, 0, do_list, help_list},
    {"status", "", 0, 0, do_status, help_status},
    {"servos", "", 0, 1, do_servos, help_servos},
    {"faults", "", 0, 0, do_faults, help_faults},
    {"law", "", 0, 1, do_law, help_law},
    {"remote", "", 0, 1, do_remote, help_remote},
    {"settings", "", 0, 2, do_settings, help_settings},
    {"baud", "", 0, SHELL_ANY_ARGS, do_baud, help_baud},
    {"approach", "", 1, 1, do_approach, help_approach},
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
