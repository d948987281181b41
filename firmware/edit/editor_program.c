/* SPDX-License-Identifier: MIT
 * editor_program.c - the page in RAM for others: for the performer, and for programs on the line (machine.h). */
#include <string.h>
#include "editor_parts.h"
#include "page_save.h"
#include "pgm.h"
#include "tick.h"

/* ---- pages from RAM and flash, for the performer ---- */

void editor_source_read(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    editor_t *editor = context;
    if (page == editor->session.page) {
        memcpy(to, &editor->session.cells[offset], count);
    } else {
        page_store_read(page, offset, to, count);
    }
}

uint8_t editor_source_check(void *context, uint8_t page)
{
    editor_t *editor = context;
    return page == editor->session.page ? (uint8_t)session_check(&editor->session)
                                        : (uint8_t)page_store_check(editor->pages, page);
}

/* ---- what programs may do with the page in RAM ---- */

static uint8_t *program_page(void *context)
{
    editor_t *editor = context;
    return editor->session.cells;
}

static machine_status_t program_open(void *context, uint8_t page)
{
    editor_t *editor = context;
    if (editor->session.is_changed) {
        return MACHINE_ERR_UNSAVED;
    }
    editor_open(editor, page);
    return MACHINE_OK;
}

static void program_changed(void *context)
{
    editor_t *editor = context;
    session_t *session = &editor->session;
    undo_clear(&session->undo);
    session_mark_all(session);
    session_end(session);
}

static machine_status_t program_save(void *context, uint8_t page)
{
    editor_t *editor = context;
    page_save_status_t status = page_save(page, editor->session.cells);
    page_store_refresh(editor->pages, page);
    if (status != PAGE_SAVE_OK && status != PAGE_SAVE_UNCHANGED) {
        return MACHINE_ERR_SAVE;
    }
    if (page == editor->session.page) {
        session_saved(&editor->session);
    }
    return MACHINE_OK;
}

/* What goes on between the parts of a long command. */
static void program_service(void *context)
{
    editor_t *editor = context;
    if (tick_take()) {
        performer_tick(editor->performer);
    }
    performer_poll(editor->performer);
}

static const char image_name[] PROGMEM = "edit";
machine_image_t editor_image = { image_name, program_service, program_page, program_open, program_changed,
                                         program_save, NULL };
