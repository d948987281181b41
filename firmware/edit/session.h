/* SPDX-License-Identifier: MIT
 * session.h - what is being edited: one page in RAM, the work pose behind it, the cursor, what was changed.
 * Knows neither terminal nor servo. Reads flash through page_store.h, never writes it. Every change of a byte goes
 * through here: it is noted for undo and its cell is marked for the screen. Caller-owned, main loop only.
 * RAM: 576 bytes of cells, 384 of undo, 66 of marks, 9 more. */
#ifndef SESSION_H
#define SESSION_H

#include <stdbool.h>
#include <stdint.h>
#include "cells.h"
#include "page.h"
#include "undo.h"

#define SESSION_NO_STEP 0xFFu

/* Marks of a table row: what must be sent again. Bits 0..9: the cells X0..X9. */
enum {
    MARK_CELLS = 0x03FF,
    MARK_LABEL = 0x0400,        /* left of the work pose */
    MARK_HEADER_LABEL = 0x0800, /* left of X9 */
    MARK_STEP_SHIFT = 12,       /* bits 12..15: the step marker as it stands on the screen now */
    MARK_STEP_NONE = 8          /* no marker on the screen */
};

enum { SESSION_SPARE_NONE = 0, SESSION_SPARE_UNDO, SESSION_SPARE_REDO };

typedef struct {
    uint8_t page;                     /* number of the page being edited */
    uint8_t x, y;                     /* cursor: always on a cell */
    uint8_t go_step;                  /* step last sent by GO, or SESSION_NO_STEP */
    bool hex;                         /* numbers are hexadecimal */
    bool was_damaged;                 /* the checksum was wrong when the page was opened; a save repairs it */
    bool is_changed;                  /* differs from what flash holds: the unsaved mark */
    bool was_changed;                 /* the same, before the command under way */
    bool undo_reloads;                /* the last command was too large to note, but what was there is in flash */
    uint8_t spare_for;                /* what session_undo may do with the spare page: SESSION_SPARE_... */
    uint16_t spare_crc;               /* of the spare page: a play has overwritten it when it no longer fits */
    uint8_t *spare;                   /* PAGE_BYTES for the page as it was before the command, or NULL: the caller's */
    uint8_t cells[CELLS_BYTES];       /* page, then the work pose (STP7) */
    uint16_t marks[CELLS_ROWS];       /* written here, taken by the screen */
    undo_t undo;
} session_t;

extern session_t the_session;   /* the only one: all functions here are about it */

/* Opens page 1, as after power-on; the work pose is ---- in all joints, until the robot says more;
 * its speed that of a new page: a first WRITE must not store speed 0. */
void session_init(void);

/* Opens `page` (0..127) from flash; what was changed is dropped, the undo history too. Cursor and work pose stay. Only
 * cells that differ are marked. An erased page opens as a new one. */
void session_open(uint8_t page);

/* Editing commands: begin, any number of session_set..., end. */
void session_begin(void);
void session_set_byte(uint16_t address, uint8_t byte);
void session_set_word(uint16_t address, uint16_t word);
void session_set_bytes(uint16_t address, const uint8_t *bytes, uint8_t count);
/* Recomputes is_changed. false: the change is done but cannot be undone. */
bool session_end(void);

/* Whole-page edits; each within begin and end. They can be undone even when undo.h has no room for them: from the spare
 * page, if there was one, or if the page was as in flash before. session_load: the contents of flash page `from` (COPY). */
void session_load(uint8_t from);
void session_clear(void);
/* Permutes whole steps (UNDO_TURN(...)): instead of session_begin, before any session_set. */
void session_begin_turn(uint8_t turn);

/* One command back, or forth again. false: there is none. */
bool session_undo(void);
bool session_redo(void);

/* The work pose: never undone. */
void session_set_pose(uint8_t joint, uint16_t word);
uint16_t session_pose(uint8_t joint);

/* Page 0: the trim of `joint` (third step) from master pose and this robot's pose, when both are positions. */
void session_update_trim(uint8_t joint);

/* Number of steps, 0..7 whatever the page says. */
uint8_t session_steps(void);

/* Where step 0..6 begins in cells; step 7 is the work pose. */
uint16_t session_step_at(uint8_t step);

/* Word of joint in step 0..6. */
uint16_t session_word(uint8_t step, uint8_t joint);

/* What flash would hold for byte `offset` of a new page. */
uint8_t session_new_byte(uint16_t offset);

/* What is wrong with the page as it stands here: its checksum as it was opened, the rest as it is now. */
page_status_t session_check(void);

/* The same without the checksum, which a save makes anew. */
page_status_t session_check_fields(void);

/* true when flash page `page` holds nothing: erased, or a good page without name and step. */
bool session_is_empty(uint8_t page);

/* The page was written to flash as it is. */
void session_saved(void);

/* Bytes of the page were changed from outside: nothing of it can be undone. */
void session_replaced(void);

/* Marks. */
void session_mark(uint8_t x, uint8_t y);
void session_mark_all(void);

/* Moves the cursor one cell, as editor-original.md section 4 says; what does not exist is not entered. */
typedef enum { SESSION_UP, SESSION_DOWN, SESSION_RIGHT, SESSION_LEFT } session_way_t;
void session_move(session_way_t way);

#endif
