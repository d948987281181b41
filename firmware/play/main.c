/* SPDX-License-Identifier: MIT
 * main.c - Play: the image that a robot runs without a PC.
 *
 *   console bytes --> inputs --> codes --------------> performer --> servo_link --> bus
 *                       |                                 |
 *                       +--> typed text --> shell         +--> events --> status lines
 *                                             |
 *                                             +--> commands --> views
 *
 * One loop. play_service also runs while text waits for room on the serial line. So a tick is late by no more than the
 * longest single piece of other work, a few ms of a search by name. Nothing moves at power-on. */
#include "board.h"
#include "channel.h"
#include "commands.h"
#include "console.h"
#include "journal.h"
#include "performer_shape.h"
#include "play.h"
#include "report.h"
#include "text.h"
#include "views.h"

static play_t play;

/* ---- what requests.h wants to know ---- */

static void serve(void)
{
    play_service(&play);
}

static void restart(void)
{
    board_restart(&play.store, &play.settings);
}

static void tell_shape(void)
{
    views_print_shape(&play.performer);
}

static const char name[] PROGMEM = "play";
TEXT_NAMED(can, ",shape,aim");
const requests_image_t requests_image = {
    .name_P = name, .can_P = can, .performer = &play.performer, .servos = &play.servos, .pages = &play.pages,
    .context = &play, .own = &commands_shared,
    .where = tell_shape,
    .serve = serve, .restart = restart,
};

/* Characters since the last line end; a status line must cover them. */
static uint8_t column;

/* ---- text ---- */

static void put(char character)
{
    if (!channel_is_printing()) {   /* a terminal does not show what a program is answered */
        column = character == '\n' ? 0 : (uint8_t)(column + (character >= ' ' && column < UINT8_MAX ? 1 : 0));
    }
    while (!console_put((uint8_t)character)) {
        play_service(&play);
        board_idle();
    }
}

/* Prints the prompt and what has been typed. */
static void prompt(void)
{
    TEXT("] ");
    for (uint8_t i = 0; i < play.shell.length; i++) {
        text_put(play.shell.line[i]);
    }
}

/* Ends a status line over the prompt and prints again what was being typed. */
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

/* Events that the setting `talk` 0 suppresses: all that are no faults. */
static bool is_chatter(uint8_t kind)
{
    return kind == PERFORMER_EV_APPROACH || kind == PERFORMER_EV_STEP || kind == PERFORMER_EV_LINK;
}

static void print_news(void)
{
    performer_event_t event;
    inputs_refusal_t refusal;
    if (performer_next_event(&play.performer, &event)) {
        if (play.settings.talk == 0 && is_chatter(event.kind)) {
            return;
        }
        const uint8_t covered = begin_status_line();
        report_event(&event);
        end_status_line(covered);
    } else if (inputs_next_refusal(&play.inputs, &refusal)) {
        const uint8_t covered = begin_status_line();
        views_print_refusal(&refusal);
        end_status_line(covered);
    }
}

/* Prints a line of @watch by itself, whatever was being typed. */
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

/* A byte of the shell's. */
static void type(uint8_t byte)
{
    const shell_event_t event = shell_byte(&play.shell, byte);
    if (event == SHELL_TYPING) {
        return;
    }
    text_line_end();
    if (play.line[0] == '@') {
        requests_line(play.line, play.shell.fault);
    } else if (event == SHELL_LINE) {
        commands_run(&play);
    } else {
        shell_print_refusal(play.shell.fault);
        text_line_end();
    }
    shell_clear(&play.shell);
    prompt();
}

static void take_typed(void)
{
    uint8_t byte;
    if (!inputs_get(&play.inputs, &byte)) {
        if (channel_is_cut_off()) {
            requests_answer_channel();
        }
        return;
    }
    if (byte >= INPUTS_HOLE) {
        if (!channel_is_open()) {   /* else the request's CRC tells it */
            shell_lose(&play.shell, (uint8_t)(byte - INPUTS_HOLE));
        }
        return;
    }
    switch (channel_byte(byte)) {
    case CHANNEL_NONE:
        type(byte);
        break;
    case CHANNEL_LINE:
        requests_answer_channel();
        break;
    default:
        break;
    }
}

static void greet(settings_status_t settings)
{
    text_line_end();
    report_failed_assert();
    views_print_version();
    if (journal_is_pending()) { /* our loader would have completed it; Play cannot write flash */
        TEXT("A save was cut off: start Edit once, it completes the page");
        text_line_end();
    }
    if (settings == SETTINGS_DAMAGED) {
        TEXT("The settings were damaged: these are the defaults");
        text_line_end();
    }
    views_print_servos_found(&play);
    prompt();
}

/* NOINLINE: else what the loading of settings needs, 100 bytes, lies on the stack below every tick. */
static NOINLINE void start(void)
{
    text_init(put);
    const settings_status_t status = settings_load(&play.store, &play.settings);
    page_store_init(&play.pages);
    servo_link_init(&play.servos);
    performer_init(&play.performer, &play.pages.source, &play.servos, &play.settings);
    performer_set_layers(&play.performer, &play.layers);
    inputs_init(&play.inputs, &play.performer, &play.pages, &play.settings);
    shell_init(&play.shell, play.line, sizeof play.line, play.history, sizeof play.history);
    console_set_flow(play.settings.flow != 0);
    if (play.settings.fast_line != 0) {
        console_set_rate(CONSOLE_RATE_115200);
    }
    play_find_servos(&play);
    greet(status);
}

/* Whether the loop has work that no interrupt will announce. */
static bool has_work(void)
{
    return ring_count(&play.inputs.typed) > 0 || play.performer.events.count > 0 ||
           play.performer.state == PERFORMER_READY;
}

int main(void)
{
    board_start();
    start();
    for (;;) {
        play_service(&play);
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
