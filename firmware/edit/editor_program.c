/* SPDX-License-Identifier: MIT
 * editor_program.c - the page in RAM for others: for the performer, and for programs on the line (machine.h). */
#include <string.h>
#include "board.h"
#include "editor_parts.h"
#include "page_save.h"
#include "pgm.h"
#include "tick.h"

/* ---- pages from RAM and flash, for the performer ---- */

void editor_source_read(void *context __attribute__((unused)), uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    if (page == the_session.page) {
        memcpy(to, &the_session.cells[offset], count);
    } else {
        page_store_read(page, offset, to, count);
    }
}

uint8_t editor_source_check(void *context __attribute__((unused)), uint8_t page)
{
    return page == the_session.page ? (uint8_t)session_check()
                                        : (uint8_t)page_store_check(&the_pages, page);
}

/* ---- what programs may do with the page in RAM ---- */

static uint8_t *program_page(void *context __attribute__((unused)))
{
    return the_session.cells;
}

static machine_status_t program_open(void *context __attribute__((unused)), uint8_t page)
{
    if (the_session.is_changed) {
        return MACHINE_ERR_UNSAVED;
    }
    editor_open(page);
    return MACHINE_OK;
}

static void program_changed(void *context __attribute__((unused)))
{
    undo_clear(&the_session.undo);
    session_mark_all();
    session_end();
}

static machine_status_t program_save(void *context __attribute__((unused)), uint8_t page)
{
    if (!performer_is_idle(&the_performer)) {
        return MACHINE_ERR_BUSY;
    }
    page_save_status_t status = page_save(page, the_session.cells);
    page_store_refresh(&the_pages, page);
    if (status != PAGE_SAVE_OK && status != PAGE_SAVE_UNCHANGED) {
        return MACHINE_ERR_SAVE;
    }
    if (page == the_session.page) {
        session_saved();
    }
    return MACHINE_OK;
}

/* What goes on between the parts of a long command. */
static void program_service(void *context __attribute__((unused)))
{
    if (tick_take()) {
        performer_tick(&the_performer);
    }
    performer_poll(&the_performer);
}

static void __attribute__((noreturn)) program_restart(void *context __attribute__((unused)))
{
    board_restart(&the_settings_store, &the_settings);
}

static const char image_name[] PROGMEM = "edit";
const machine_image_t editor_image = { image_name, program_service, program_page, program_open, program_changed,
                                         program_save, program_restart, NULL, NULL, NULL };
