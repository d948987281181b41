/* SPDX-License-Identifier: MIT
 * session.h - the state of editing: one page in RAM, the work pose after it, the cursor, undo.
 * Knows neither terminal nor servo. Reads flash through page_store.h, never writes it. Every change of a byte passes
 * through here: it is recorded for undo and its cell is marked for the screen. One instance; main loop only.
 * RAM: one session_t; most of it is the cells and the undo history. */
#ifndef SESSION_H
#define SESSION_H

#include <stdbool.h>
#include <stdint.h>
#include "cells.h"
#include "page.h"
#include "undo.h"

#define SESSION_NO_STEP 0xFFu

/* Marks of a table row: the parts that must be sent again. Bits 0..9: the cells X0..X9. */
enum {
    MARK_CELLS = 0x03FF,
    MARK_LABEL = 0x0400,        /* left of the work pose */
    MARK_HEADER_LABEL = 0x0800, /* left of X9 */
    MARK_STEP_SHIFT = 12,       /* bits 12..15: the step marker now on the screen */
    MARK_STEP_NONE = 8          /* no marker on the screen */
};

enum { SESSION_SPARE_NONE = 0, SESSION_SPARE_UNDO, SESSION_SPARE_REDO };

typedef struct {
    uint8_t page;                     /* number of the page being edited */
    uint8_t x, y;                     /* cursor: always on a cell */
    uint8_t go_step;                  /* the step that GO sent last, or SESSION_NO_STEP */
    bool hex;                         /* numbers are hexadecimal */
    bool was_damaged;                 /* the checksum was wrong when the page was opened; a save repairs it */
    bool is_changed;                  /* differs from flash: the unsaved mark */
    bool was_changed;                 /* is_changed before the current command */
    bool is_begun;                    /* an edit has begun and changed nothing yet */
    bool undo_reloads;                /* the last command was too large to record, but flash has the previous page */
    uint8_t spare_for;                /* what the spare page may be used for: SESSION_SPARE_... */
    uint16_t spare_crc;               /* of the spare page; if it is wrong, a play has overwritten the page */
    uint8_t *spare;                   /* the caller's PAGE_BYTES for the page before the command, or NULL */
    uint8_t cells[CELLS_BYTES];       /* page, then the work pose (STP7) */
    uint16_t marks[CELLS_ROWS];       /* written here, taken by the screen */
    undo_t undo;
} session_t;

extern session_t the_session;   /* the only instance: all functions here use it */

/* Opens page 1, as after power-on. The work pose is ---- in all joints until the robot is read. Its speed is that of a new
 * page, because a first WRITE must not store speed 0. */
void session_init(void);

/* Opens `page` (0..PAGE_COUNT - 1) from flash. Drops all changes and the undo history; keeps cursor and work pose. Marks
 * only the cells that differ. An erased page opens as a new one. */
void session_open(uint8_t page);

/* An editing command is session_begin, any number of session_set..., session_end. It sets no byte twice, so is_begun tells
 * until session_end whether it has changed anything. One that has not is no edit: what UNDO and REDO can do stays. */
void session_begin(void);
void session_set_byte(uint16_t address, uint8_t byte);
void session_set_word(uint16_t address, uint16_t word);
/* Sets the number of steps. A step that comes into use with time 0, as in the empty pages of a file, gets the time of a new
 * page: one tick for any distance would be a leap. */
void session_set_steps(uint8_t steps);
/* Updates is_changed. false: the change is done but cannot be undone. */
bool session_end(void);

/* Edits of the whole page, between begin and end: load copies flash page `from` (COPY), clear makes a new page. If undo.h
 * has no room, they can still be undone from the spare page, or from flash if the page had no unsaved changes. */
void session_load(uint8_t from);
void session_clear(void);
/* Replaces session_begin and permutes whole steps: UNDO_TURN(...). */
void session_begin_turn(uint8_t turn);

/* Undoes or redoes one command. false: there is none. */
bool session_undo(void);
bool session_redo(void);

/* The work pose; not part of undo. */
void session_set_pose(uint8_t joint, uint16_t word);
uint16_t session_pose(uint8_t joint);

/* Page 0: sets the trim of `joint` (third step) from the master pose and this robot's pose, if both are positions. */
void session_update_trim(uint8_t joint);

/* Number of steps, limited to 0..7. */
uint8_t session_steps(void);

/* Where step 0..6 begins in cells; step 7 is the work pose. */
uint16_t session_step_at(uint8_t step);

/* Word of joint in step 0..6. */
uint16_t session_word(uint8_t step, uint8_t joint);

/* Byte `offset` of a new page. */
uint8_t session_new_byte(uint16_t offset);

/* What is wrong with the page: its checksum when it was opened, or its current fields. */
page_status_t session_check(void);

/* The same without the checksum, which a save sets. */
page_status_t session_check_fields(void);

/* Whether flash page `page` is erased, or has neither name nor steps and a good checksum. */
bool session_is_empty(uint8_t page);

/* Call after the page was written to flash. */
void session_saved(void);

/* Call after bytes of the page were changed from outside: no edit before can be undone or redone. */
void session_replaced(void);

/* Mark a cell, all cells, the labels of all joints. */
void session_mark(uint8_t x, uint8_t y);
void session_mark_all(void);
void session_mark_labels(void);

/* Moves the cursor by one cell (ORIGINAL.md section 4), if there is one. */
typedef enum { SESSION_UP, SESSION_DOWN, SESSION_RIGHT, SESSION_LEFT } session_way_t;
void session_move(session_way_t way);

#endif
