/* SPDX-License-Identifier: MIT
 * dialog.h - the state of the dialog with the user: the line being typed or run, questions, lists, messages on the command
 * row. Commands (cmd_*.c) use it; editor_keys.c, above them, feeds it with keys. One instance; main loop only.
 *
 *              first character                 CR
 *   TABLE ----------------------> LINE -----------------> run --> TABLE
 *     ^                                                    |
 *     |   any key   +--> ASK: one key, then run again or TABLE
 *     +-------------+--> NAME: a second line
 *                   +--> LIST: item by item; MORE: a screen is full, or the list has ended
 *                   +--> PLAY: until the performer is idle
 *   '@' as the first character: PROGRAM, a line of requests.h, answered in plain text */
#ifndef DIALOG_H
#define DIALOG_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "shell.h"

#define DIALOG_LINE_BYTES 112u    /* a line of a program (requests.h); the screen shows 77 */
#define DIALOG_HISTORY_BYTES 30u
enum { LATE_TICKS = 96 };         /* 0.75 s: a space this soon after a list, a play or an ignored space is ignored */
enum { ROW_TICKS = 512 };         /* 4 s: time to read the row before faults replace it */
enum { WELL_TICKS = 128 };        /* 1 s: time to read that all servos are well */

typedef enum {
    DIALOG_TABLE = 0, DIALOG_LINE, DIALOG_ASK, DIALOG_NAME, DIALOG_LIST, DIALOG_PLAY,
    DIALOG_MORE, DIALOG_PROGRAM
} dialog_mode_t;

/* Further results of a command handler: the mode that follows. */
enum { DIALOG_TO_ASK = DIALOG_ASK, DIALOG_TO_NAME = DIALOG_NAME, DIALOG_TO_LIST = DIALOG_LIST,
       DIALOG_TO_PLAY = DIALOG_PLAY };

/* Prints item `item` as one line, or nothing. false: there is no such item, so the list ends. */
typedef bool (*dialog_item_t)(uint16_t item);

/* Small fields come first: the AVR accesses 64 bytes from a pointer on cheaply. */
typedef struct {
    uint8_t mode;                  /* dialog_mode_t */
    uint8_t asked, answered;       /* questions that this run has asked, and how many were answered with yes */
    uint16_t next_item;            /* of the list being shown */
    uint8_t lines;                 /* of the list on the screen */
    uint8_t list_first, list_last; /* pages of LIST */
    uint8_t take_page, take_first, take_count; /* steps noted by TAKE; a count of 0: none (each page number is a real one) */
    uint16_t take_crc;             /* of those steps when they were noted; 0, which no empty CRC is: none */
    uint8_t late_ticks;            /* counts down; until then a space changes no cell */
    uint8_t well_ticks;            /* counts down from WELL_TICKS while the row shows that all servos are well */
    uint16_t row_ticks;            /* counts down from ROW_TICKS; then faults are shown again */
    bool step_due;                 /* a step has begun; the row will show it when the line has room */
    bool faults_stand;             /* the row has shown faults, but not yet that all servos are well */
    bool faults_due;               /* a servo has a new fault; the row will show it when the line has room */
    bool broken_off;               /* a fault ended the last play; the row shows it until the next line is run */
    uint8_t stale_bytes;           /* bytes already waiting when a question was asked: not an answer */
    uint16_t quiet_since;          /* tick of the last received byte, or of the question */
    shell_args_t args;             /* of the line being run */
    dialog_item_t item;            /* of the list being shown */
    shell_t shell;
    char line[DIALOG_LINE_BYTES];
    char history[DIALOG_HISTORY_BYTES];
} dialog_t;

extern dialog_t the_dialog;   /* the only instance: all functions here use it */

void dialog_init(void);

/* ---- for commands ---- */

/* Asks a question; the text says what would be lost. true: continue (answered with yes, or no need to ask). false: return
 * DIALOG_TO_ASK; the command runs again after a yes. */
bool dialog_ask(const char *question_P);
bool dialog_ask_unsaved(void);

/* Begins a list: `title_P` is its first line. Returns DIALOG_TO_LIST. */
uint8_t dialog_list(dialog_item_t item, const char *title_P);

/* Prints why a command is refused. Returns SHELL_ERR_REPORTED. */
uint8_t dialog_refuse(const char *sentence_P);

/* Ends an editing command; prints a message if it has changed nothing or cannot be undone. Returns SHELL_OK. */
uint8_t dialog_edited(void);

/* Prints a message about these joints: "No answer: ID 5-7"; nothing if there are none. */
void dialog_tell_joints(const char *what_P, uint32_t joints);

/* ---- for editor*.c ---- */

/* Ends the line and returns to the table. */
void dialog_end_line(void);

/* Begin and end a message on the command row, while no line is being typed. */
void dialog_message_begin(void);
void dialog_message_end(void);

/* Prints which servos did not answer or obey, and clears them. */
void dialog_tell_failed(void);

/* Prints the next item of a list; stops at the end of a screen or of the list. */
void dialog_list_turn(void);

#endif
