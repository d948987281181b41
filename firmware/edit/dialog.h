/* SPDX-License-Identifier: MIT
 * dialog.h - what goes on with the person at the terminal: the line being typed or run, questions, lists, messages on the
 * command row. Commands (cmd_*.c) work with it; the keys that lead it on are above them (editor_keys.c). One instance; main
 * loop only.
 *
 *              first character                 CR
 *   TABLE ----------------------> LINE -----------------> run --> TABLE
 *     ^                                                    |
 *     |   any key   +--> ASK: one key, then run again or TABLE
 *     +-------------+--> NAME: a second line
 *                   +--> LIST: item by item; MORE: a screen is full, or the list has ended
 *                   +--> PLAY: until the performer is idle
 *   '@' as first character: PROGRAM, a line of requests.h, answered on a plain terminal */
#ifndef DIALOG_H
#define DIALOG_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"
#include "shell.h"

#define DIALOG_LINE_BYTES 112u    /* a line of a program (requests.h); the screen shows 77 */
#define DIALOG_HISTORY_BYTES 30u
#define DIALOG_NO_PAGE 0xFFu
enum { LATE_TICKS = 64 };         /* half a second: a space that comes so late was meant for what has just ended */
enum { WELL_TICKS = 128 };        /* a second: long enough to be read */

typedef enum {
    DIALOG_TABLE = 0, DIALOG_LINE, DIALOG_ASK, DIALOG_NAME, DIALOG_LIST, DIALOG_PLAY,
    DIALOG_MORE, DIALOG_PROGRAM
} dialog_mode_t;

/* What a command handler returns besides SHELL_OK and SHELL_ERR_SAID: the mode that goes on from here. */
enum { DIALOG_TO_ASK = DIALOG_ASK, DIALOG_TO_NAME = DIALOG_NAME, DIALOG_TO_LIST = DIALOG_LIST,
       DIALOG_TO_PLAY = DIALOG_PLAY };

/* Prints item `item` as one line, or nothing. false: there is no such item, the list ends. */
typedef bool (*dialog_item_t)(uint8_t item);

/* Small things first: the AVR reaches 63 bytes behind a pointer with one instruction. */
typedef struct {
    uint8_t mode;                  /* dialog_mode_t */
    uint8_t asked, answered;       /* questions: put by this run, answered with yes */
    uint8_t next_item, lines;      /* of the list being shown */
    uint8_t list_first, list_last; /* pages of LIST and CHECK */
    uint8_t take_page, take_first, take_last; /* steps noted by TAKE */
    uint8_t late_ticks;            /* a play or a list has just ended: a space was meant for it */
    uint8_t well_ticks;            /* the row says that all servos are well: steps wait until it was read */
    bool step_due;                 /* a step has begun: the row says which when the line has room */
    bool faults_stand;             /* the row has told faults, and not yet that all are well */
    bool faults_due;               /* a servo has a new fault: the row says it when the line has room */
    bool broken_off;               /* a servo's fault has ended the last play: the row says so until the next line is run */
    uint16_t quiet_since;          /* tick of the last byte that came, or of the question */
    shell_args_t args;             /* of the line being run */
    dialog_item_t item;            /* of the list being shown */
    shell_t shell;
    char line[DIALOG_LINE_BYTES];
    char history[DIALOG_HISTORY_BYTES];
} dialog_t;

extern dialog_t the_dialog;   /* the only one: all functions here are about it */

void dialog_init(void);

/* ---- for commands ---- */

/* Questions; the text says what would be lost. true: go on (it was answered, or need not be asked); false: return
 * DIALOG_TO_ASK. */
bool dialog_ask(const char *question_P);
bool dialog_ask_unsaved(void);

/* Begins a list: `title_P` is its first line. Returns DIALOG_TO_LIST. */
uint8_t dialog_list(dialog_item_t item, const char *title_P);

/* Ends an editing command: tells when it cannot be undone. Returns SHELL_OK. */
uint8_t dialog_edited(void);

/* Tells on the message row what is with these joints: "No answer: ID 5-7". None: nothing. */
void dialog_tell_joints(const char *what_P, uint32_t joints) NOINLINE;

/* ---- for whoever leads it on ---- */

/* The line has been dealt with: back to the table. */
void dialog_end_line(void);

/* A message on the command row while nobody types. */
void dialog_message_begin(void);
void dialog_message_end(void);

/* Tells on the message row which servos did not answer, and forgets them. */
void dialog_tell_failed(void);

/* The next item of a list, or the end of a screen or of the list. */
void dialog_list_turn(void);

#endif
