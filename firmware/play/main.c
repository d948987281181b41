/* SPDX-License-Identifier: MIT
 * main.c - Play: the image that runs a robot without a PC.
 *
 *   console bytes --> inputs --> codes --------------> performer --> servo_link --> bus
 *                       |                                 |
 *                       +--> typed text --> shell         +--> events --> status lines
 *                                             |
 *                                             +--> commands --> views
 *
 * There is one loop. play_service also runs while text waits for room on the serial line. So a tick is late at most by the
 * longest single piece of other work, a few ms of a search by name. Nothing moves at power-on. */
#include <string.h>
#include "board.h"
#include "channel.h"
#include "commands.h"
#include "console.h"
#include "journal.h"
#include "performer_shape.h"
#include "pgm.h"
#include "play.h"
#include "report.h"
#include "text.h"
#include "views.h"

play_t the_play;

/* ---- the image, for requests.h ---- */

static void restart(void)
{
    board_restart(&the_play.store);
}

static const char name[] PROGMEM = "play";
TEXT_NAMED(can, ",shape,aim");
const requests_image_t requests_image = {
    .name_P = name, .can_P = can, .performer = &the_play.performer, .servos = &the_play.servos, .pages = &the_play.pages,
    .own = &commands_shared,
    .where = views_print_shape, .serve = play_service, .restart = restart,
};

/* Characters since the last line end; a status line must cover them. */
static uint8_t column;

/* ---- text ---- */

static void put(char character)
{
    if (!channel_is_printing()) {   /* a terminal does not show answers in the channel */
        column = character == '\n' ? 0 : (uint8_t)(column + (character >= ' ' && column < UINT8_MAX ? 1 : 0));
    }
    while (!console_put((uint8_t)character)) {
        play_service();
        board_idle();
    }
}

/* Prints the prompt and what has been typed. */
static void prompt(void)
{
    TEXT("] ");
    for (uint8_t i = 0; i < the_play.shell.length; i++) {
        text_put(the_play.shell.line[i]);
    }
}

/* Ends a status line over the prompt and reprints the typed text. */
static void end_status_line(uint8_t covered)
{
    while (column < covered) {
        text_put(' ');
    }
    text_line_end();
    prompt();
}

static uint8_t begin_status_line(void)
{
    const uint8_t covered = column;
    text_put('\r');
    column = 0;
    return covered;
}

/* Events that the setting `talk` 0 suppresses. */
static bool is_chatter(uint8_t kind)
{
    return kind == PERFORMER_EV_APPROACH || kind == PERFORMER_EV_STEP || kind == PERFORMER_EV_LINK;
}

static void print_news(void)
{
    performer_event_t event;
    inputs_refusal_t refusal;
    if (performer_next_event(&the_play.performer, &event)) {
        if (the_play.store.settings.talk == 0 && is_chatter(event.kind)) {
            return;
        }
        if (event.kind == PERFORMER_EV_UNREADY && servo_link_has(&the_play.servos.silent, event.a)) {
            event.kind = PERFORMER_EV_SILENT;
        }
        const uint8_t covered = begin_status_line();
        report_event(&event);
        end_status_line(covered);
    } else if (inputs_next_refusal(&the_play.inputs, &refusal)) {
        const uint8_t covered = begin_status_line();
        views_print_refusal(&refusal);
        end_status_line(covered);
    } else if (the_play.store.failed) {
        the_play.store.failed = false;
        const uint8_t covered = begin_status_line();
        TEXT("Settings not saved: EEPROM error");
        end_status_line(covered);
    }
}

/* Prints a @watch line on a line of its own, even while a person is typing. */
static void print_watched(void)
{
    if (requests_now_is_on_channel()) {
        requests_print_now();
        return;
    }
    if (column > 0) {
        text_line_end();
    }
    requests_print_now();
    prompt();
}

/* Always safe. And the loss may be noise of long ago, before the line began. */
static bool is_obeyed_with_losses(const char *line)
{
    return strcasecmp_P(line, PSTR("stop")) == 0 || strcasecmp_P(line, PSTR("break")) == 0;
}

typedef void (*end_t)(performer_t *performer);

/* What the last letters of a line ask for; NULL: no end. They may stand behind noise or behind a piece of a torn line. */
static end_t end_of(const char *line)
{
    const size_t length = strlen(line);
    if (length >= 4 && strcasecmp_P(line + length - 4, PSTR("stop")) == 0) {
        return performer_stop;
    }
    return length >= 5 && strcasecmp_P(line + length - 5, PSTR("break")) == 0 ? performer_break : NULL;
}

/* The line was refused. If it was to end a play, the play ends all the same. */
static void end_all_the_same(end_t end)
{
    performer_t *performer = &the_play.performer;
    if (end != NULL && (!performer_is_still(performer) || performer_layers_joints(performer) != 0)) {
        end(performer);
        TEXT("Stopping all the same");
        text_line_end();
    }
}

static void type(uint8_t byte)
{
    const shell_event_t event = shell_byte(&the_play.shell, byte);
    if (event == SHELL_TYPING) {
        return;
    }
    text_line_end();
    const end_t end = end_of(the_play.line);
    bool is_done = false;
    if (the_play.line[0] == '@') {
        is_done = event == SHELL_LINE;
        requests_line(the_play.line, the_play.shell.fault);
    } else if (event == SHELL_LINE || is_obeyed_with_losses(the_play.line)) {
        is_done = commands_run();
    } else {
        shell_print_refusal(the_play.shell.fault);
        text_line_end();
    }
    if (!is_done) {
        end_all_the_same(end);
    }
    shell_clear(&the_play.shell);
    prompt();
}

static void take_typed(void)
{
    uint8_t byte;
    if (!inputs_get(&the_play.inputs, &byte)) {
        if (inputs_are_quiet(&the_play.inputs)) {
            shell_quiet(&the_play.shell);
        }
        if (channel_is_cut_off()) {
            requests_answer_channel();
        }
        return;
    }
    if (byte >= INPUTS_HOLE) {
        if (!channel_is_open()) {   /* in a request, the CRC detects the loss */
            shell_lose(&the_play.shell, (uint8_t)(byte - INPUTS_HOLE));
        }
        return;
    }
    switch (channel_byte(byte)) {
    case CHANNEL_NONE:
        type(byte);
        break;
    case CHANNEL_LINE: {
        /* Digits end every good request. */
        const end_t end = end_of(channel_line());
        requests_answer_channel();
        end_all_the_same(end);
        break;
    }
    default:
        break;
    }
}

static void greet(settings_status_t settings)
{
    text_line_end();
    report_failed_assert();
    (void)views_version(NULL);
    if (journal_is_pending()) { /* Play cannot write flash; if our loader could not complete it, the page is worn out */
        TEXT("A save was cut off: start Edit once, it completes the page or says why not");
        text_line_end();
    }
    if (settings == SETTINGS_DAMAGED) {
        TEXT("The settings were damaged: these are the defaults");
        text_line_end();
    }
    if (page_store_is_damaged(&the_play.pages, 0)) {
        TEXT("Page 0 is damaged: no trim");
        text_line_end();
    }
    views_print_servos_found();
    prompt();
}

/* NOINLINE: inlined, the 100 bytes for loading settings would stay on the stack under every tick. */
static NOINLINE void start(void)
{
    text_init(put);
    const settings_status_t status = settings_load(&the_play.store);
    page_store_init(&the_play.pages);
    servo_link_init(&the_play.servos);
    performer_init(&the_play.performer, &the_play.pages.source, &the_play.servos, &the_play.store.settings);
    performer_set_layers(&the_play.performer, &the_play.layers);
    inputs_init(&the_play.inputs, &the_play.performer, &the_play.pages);
    shell_init(&the_play.shell, the_play.line, sizeof the_play.line, the_play.history, sizeof the_play.history);
    console_set_flow(the_play.store.settings.flow != 0);
    if (the_play.store.settings.fast_line != 0) {
        console_set_rate(CONSOLE_RATE_115200);
    }
    play_find_servos();
    greet(status);
}

/* Whether the loop has work that no interrupt will announce. */
static bool has_work(void)
{
    return ring_count(&the_play.inputs.typed) > 0 || the_play.performer.events.count > 0 ||
           the_play.performer.state == PERFORMER_READY;
}

int main(void)
{
    board_start();
    start();
    for (;;) {
        play_service();
        print_news();
        if (requests_now_is_due()) {
            print_watched();
        }
        take_typed();
        if (!has_work()) {
            board_idle();
        }
    }
}
