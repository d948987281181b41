/* SPDX-License-Identifier: MIT
 * cmd_page.c - commands for the whole page: open, copy, new, save, name, undo, exit. */
#include "board.h"
#include "commands.h"
#include "compiler.h"
#include "console.h"
#include "page_save.h"
#include "page_service.h"
#include "pgm.h"
#include "report.h"
#include "text.h"

#include <string.h>

#define NAME_CHARS (PAGE_NAME_BYTES - 1u)

static uint8_t open_asking(uint16_t page)
{
    if (page >= PAGE_COUNT) {
        return dialog_refuse(TEXT_P("No such page"));
    }
    if (!dialog_ask_unsaved()) {
        return DIALOG_TO_ASK;
    }
    robot_open_page((uint8_t)page);
    return SHELL_OK;
}

COMMAND(cmd_page)
{
    return open_asking(args->number[0]);
}

COMMAND(cmd_next)
{
    return open_asking(the_session.page + 1u);
}

COMMAND(cmd_before)
{
    return open_asking((uint16_t)(the_session.page - 1u));
}

/* Prints which other page has the name of stored page `named`, because Play's `play wave` needs a unique name. NOINLINE:
 * inlined, the names would stay on the stack while the page is saved. */
static NOINLINE void tell_namesake(uint8_t named, uint8_t own)
{
    char name[PAGE_NAME_BYTES];
    page_store_name(named, name);
    if (name[0] == '\0') {
        return;
    }
    uint8_t other = page_store_find(&the_pages, name, 0);
    if (other == own) {
        other = page_store_find(&the_pages, name, own);
    }
    if (other != 0) {
        the_screen.lead = true;
        text_P_number(TEXT_P("Page "), other);
        TEXT(" has this name too");
    }
}

static bool ask_trim(void)
{
    return dialog_ask(TEXT_P("Page 0 holds the trim"));
}

COMMAND(cmd_copy)
{
    if (!dialog_ask_unsaved()) {
        return DIALOG_TO_ASK;
    }
    uint8_t from = (uint8_t)args->number[0];
    if (the_session.page == 0 && from != 0 && !ask_trim()) {
        return DIALOG_TO_ASK;
    }
    session_begin();
    session_load(from);
    tell_namesake(from, the_session.page);
    return dialog_edited();
}

COMMAND(cmd_new)
{
    if (!dialog_ask(TEXT_P("The page would be emptied"))) {
        return DIALOG_TO_ASK;
    }
    session_begin();
    session_clear();
    return dialog_edited();
}

/* ---- save ---- */

/* A stored page has no torque-off marks (PAGE_FORMAT.md): such joints become unused in the step. */
static void clear_off_marks(void)
{
    uint8_t count = 0;
    for (uint8_t step = 0; step < PAGE_STEPS; step++) {
        const uint16_t at = session_step_at(step);
        for (uint8_t place = 0; place < PAGE_STEP_AT_PAUSE; place += 2u) {
            if ((the_session.cells[at + place + 1u] & PAGE_POS_TORQUE_OFF >> 8) == 0) {
                continue;   /* nearly all words, so checked without calls: 0.6 ms of SAVE's 60 */
            }
            const uint16_t word = cell_word(the_session.cells, at + place);
            if (!cell_is_off(word) || (the_session.page == 0 && step == CELL_X_OFFSET - CELL_X_STEP0)) {
                continue;
            }
            if (count++ == 0) {
                session_begin();
            }
            session_set_word(at + place, PAGE_POS_UNUSED | (word & PAGE_POS_MAX));
        }
    }
    if (count != 0) {
        (void)session_end();
        text_number(count);
        TEXT(" ???? saved as ----, ");
    }
}

/* Refuses faults that a save would not repair. */
static bool page_is_sound(void)
{
    page_status_t fault = session_check_fields();
    if (fault != PAGE_OK) {
        TEXT("Not saved: ");
        text_P(report_page_fault_P(fault));
    }
    return fault == PAGE_OK;
}

static bool overwriting_is_meant(uint8_t page)
{
    if (page == 0 && the_session.page != 0) {
        return ask_trim();
    }
    if (page != the_session.page) {
        return session_is_empty(page) || dialog_ask(TEXT_P("That page is not empty"));
    }
    return !page_store_is_damaged(&the_pages, page) || dialog_ask(TEXT_P("That page is damaged"));
}

static uint8_t save_by_mailbox(uint8_t page)
{
    if (!dialog_ask(TEXT_P("SAVE restarts (5 s)"))) {
        return DIALOG_TO_ASK;
    }
    page_save_by_mailbox(page, the_session.cells);
    board_restart(&the_settings_store);
}

page_save_status_t cmd_page_save(uint8_t page)
{
    servo_link_quiet(&the_servos);   /* no answer may be pending, because interrupts go off for 9 ms at a time */
    page_save_status_t status = page_save(page, the_session.cells);
    page_store_refresh(&the_pages, page);
    if (page == the_session.page && status <= PAGE_SAVE_UNCHANGED) {
        session_saved();
    }
    if (page == 0) {
        robot_set_trim();
    }
    return status;
}

const char *cmd_page_saved_P(page_save_status_t status)
{
    TEXT_NAMED(ok, "OK");
    TEXT_NAMED(unchanged, "OK, no change");
    TEXT_NAMED(verify, "Not saved: flash error");
    TEXT_NAMED(no_writer, "No boot loader can write: kept in RAM");
    TEXT_NAMED(pending, "Not saved: the next start tries again");
    TEXT_NAMED(exit_first, "Not saved: EXIT first, an earlier save is pending");
    static const char *const results[] PROGMEM = {
        [PAGE_SAVE_OK] = ok, [PAGE_SAVE_UNCHANGED] = unchanged, [PAGE_SAVE_ERR_VERIFY] = verify,
        [PAGE_SAVE_ERR_NO_WRITER] = no_writer, [PAGE_SAVE_ERR_PENDING] = pending, [PAGE_SAVE_ERR_RESTART] = exit_first,
    };
    return pgm_read_ptr(&results[status]);
}

COMMAND(cmd_save)
{
    uint8_t page = args->count > 1 ? (uint8_t)args->number[0] : the_session.page;
    if (!page_is_sound()) {
        return SHELL_ERR_REPORTED;
    }
    if (!overwriting_is_meant(page)) {
        return DIALOG_TO_ASK;
    }
    the_screen.lead = true;
    clear_off_marks();
    if (page_service_kind() == PAGE_SERVICE_MAILBOX) {
        return save_by_mailbox(page);
    }
    page_save_status_t status = cmd_page_save(page);
    text_P(cmd_page_saved_P(status));
    if (status == PAGE_SAVE_OK) {
        tell_namesake(page, page);
    }
    return SHELL_OK;
}

COMMAND(cmd_exit)
{
    if (!dialog_ask_unsaved()) {
        return DIALOG_TO_ASK;
    }
    board_restart(&the_settings_store);
}

/* ---- name ---- */

/* An empty line keeps the old name, because NAME was probably a mistake. A single space clears it. */
void cmd_name_done(const char *name)
{
    uint8_t length = (uint8_t)strlen(name);
    if (length == 0 || length > NAME_CHARS) {
        the_screen.lead = true;
        text_P(length == 0 ? TEXT_P("Name kept") : TEXT_P("At most 13 characters: name kept"));
        return;
    }
    session_begin();
    for (uint8_t i = 0; i < PAGE_NAME_BYTES; i++) {
        bool is_kept = i < length && !(length == 1 && name[0] == ' ');
        session_set_byte(PAGE_AT_NAME + i, is_kept ? (uint8_t)name[i] : 0);
    }
    (void)dialog_edited();
}

COMMAND(cmd_name)
{
    if (args->count > 1) {
        cmd_name_done(shell_word(args, 1));
        return SHELL_OK;
    }
    TEXT("name:");
    return DIALOG_TO_NAME;
}

/* ---- undo ---- */

static uint8_t say_unless(bool done, const char *text)
{
    if (!done) {
        text_P(text);
    }
    return SHELL_OK;
}

COMMAND(cmd_undo)
{
    return say_unless(session_undo(), TEXT_P("Nothing to undo"));
}

COMMAND(cmd_redo)
{
    return say_unless(session_redo(), TEXT_P("Nothing to redo"));
}
