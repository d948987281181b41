/* SPDX-License-Identifier: MIT */
#include "editor.h"

#include <string.h>
#include "ansi.h"
#include "channel.h"
#include "commands.h"
#include "console.h"
#include "dialog.h"
#include "editor_keys.h"
#include "parts.h"
#include "report.h"
#include "requests.h"
#include "robot.h"
#include "screen.h"
#include "session.h"
#include "system.h"
#include "text.h"
#include "tick.h"

enum { PAINT_ROOM = CONSOLE_TX_BYTES / 2, BYTES_PER_TURN = 32 };

static const char *notice;    /* in flash; NULL when a line has been typed after it */
static uint8_t notice_rows;   /* of the screen on which it was shown; 0: not yet */

/* ---- pages for the performer: the open one from RAM, the others from flash ---- */

static void source_read(void *context __attribute__((unused)), uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    if (page == the_session.page) {
        memcpy(to, &the_session.cells[offset], count);
    } else {
        page_store_read(page, offset, to, count);
    }
}

static uint8_t source_check(void *context __attribute__((unused)), uint8_t page)
{
    return page == the_session.page ? (uint8_t)session_check() : (uint8_t)page_store_check(&the_pages, page);
}

static const page_source_t source = { NULL, source_read, source_check };

/* ---- start ---- */

void editor_init(const char *notice_P)
{
    notice = notice_P;
    channel_init();
    dialog_init();
    editor_keys_init();
    session_init();
    screen_init();
    performer_set_source(&the_performer, &source);
    robot_init();
    screen_ask_size();
    screen_sync();
}

void editor_put(char character)
{
    if (channel_is_printing()) {
        ansi_put(character);   /* the terminal does not show it: do not count cursor movement or list lines */
        return;
    }
    if (character == '\n') {
        the_dialog.lines++;
    }
    screen_put(character);
}

/* ---- the main loop ---- */

/* The time of the answer does not count as a pause between a person's keys. */
static void answer_program(void)
{
    const uint16_t begun = tick_now16();
    requests_answer_channel();
    the_dialog.quiet_since = (uint16_t)(the_dialog.quiet_since + tick_now16() - begun);
    screen_sync();
}

/* Keys wait while a list prints and while joints slow down after a break: they are meant for what follows. */
static bool keys_wait(void)
{
    return the_dialog.mode == DIALOG_LIST || (the_dialog.mode == DIALOG_PLAY && the_performer.leaving);
}

static bool may_take_byte(void)
{
    uint8_t next;
    return channel_is_open() || !keys_wait() || (console_peek(&next) && next == CHANNEL_BEGIN);
}

/* Takes the end of a motion before the next key or request: it restores the rate and reads the pose, which the key may need.
 * In most modes nobody else takes events, and an old end must not count for the next play. */
static void take_end(void)
{
    while (performer_is_idle(&the_performer) && the_performer.events.count != 0) {
        cmd_play_events(false);
    }
}

static void take_byte(uint8_t byte)
{
    take_end();
    const bool is_stale = the_dialog.stale_bytes != 0;
    const channel_event_t event = channel_byte(byte);
    the_dialog.stale_bytes = (uint8_t)(the_dialog.stale_bytes - is_stale);
    if (event == CHANNEL_LINE) {
        answer_program();
    } else if (event == CHANNEL_NONE && !is_stale) {
        shell_lose(&the_dialog.shell, console_lost());
        editor_byte(byte);
    }
}

static void take_bytes(void)
{
    uint8_t byte;
    for (uint8_t i = 0; i < BYTES_PER_TURN && may_take_byte() && console_get(&byte); i++) {
        system_kick();   /* the bytes of one turn may be several requests, and the answer to one takes up to 0.6 s */
        take_byte(byte);
    }
    if (channel_is_cut_off()) {
        answer_program();
    }
    editor_quiet();
}

static void tick_work(void)
{
    performer_tick(&the_performer);
    settings_save_poll(&the_settings_store);
    if (the_dialog.late_ticks != 0) {
        the_dialog.late_ticks--;
    }
    if (the_dialog.well_ticks != 0) {
        the_dialog.well_ticks--;
    }
    if (the_dialog.row_ticks != 0 && --the_dialog.row_ticks == 0) {
        cmd_play_tell_again();
    }
    if (performer_is_idle(&the_performer)) {
        robot_follow();
    } else {
        robot_follow_play(the_dialog.mode == DIALOG_PLAY);
    }
}

/* Prints a @now line: in the channel, or on the plain terminal of programs between two of their lines. */
static void print_now(void)
{
    const uint8_t sink = the_screen.sink;
    const bool has_line = requests_now_is_on_channel() || (the_screen.hidden && the_dialog.mode == DIALOG_TABLE);
    if (has_line && requests_now_is_due()) {
        the_screen.sink = SCREEN_PLAIN;
        requests_print_now();
        the_screen.sink = sink;
    }
}

/* Shows the notice after the first screen, and again when the terminal tells another size, because the redraw erases it: a
 * PC draws the first screen before the answer can come. It comes 4 s after the answer to a line that was typed before, and
 * not again after a line. */
static void tell_notice(void)
{
    const bool is_answer_shown = the_dialog.row_ticks != 0;
    if (is_answer_shown && notice_rows != 0) {
        notice = NULL;
    }
    if (notice != NULL && the_dialog.mode == DIALOG_TABLE && !is_answer_shown && notice_rows != the_screen.rows) {
        dialog_message_begin();
        report_failed_assert();
        text_P(notice);
        dialog_tell_joints(TEXT_P("Not used, at 57142 bps"), the_servos.slow);
        dialog_message_end();
        notice_rows = the_screen.rows;
    }
}

bool editor_turn(void)
{
    take_bytes();
    if (tick_take()) {
        tick_work();
    }
    performer_poll(&the_performer);
    uint8_t room = console_room();
    if (the_dialog.mode == DIALOG_TABLE || the_dialog.mode == DIALOG_PLAY) {
        cmd_play_events(room >= CONSOLE_TX_BYTES - 1u);
    }
    print_now();
    if (the_dialog.mode == DIALOG_LIST) {
        dialog_list_turn();
        return true;
    }
    if (the_dialog.faults_due || room < PAINT_ROOM) {
        return false;
    }
    if (screen_paint()) {
        return true;
    }
    tell_notice();
    return false;
}
