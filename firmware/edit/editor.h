/* SPDX-License-Identifier: MIT
 * editor.h - the editor as a whole: which key means what now, lines, questions, lists, playing.
 * Ties session, screen, robot and performer together; the commands are in cmd_*.c, one topic each, their table in
 * commands.c. One instance, in main.c; main loop only; editor_turn never blocks longer than its slowest command.
 *
 *              first character                 CR
 *   TABLE ----------------------> LINE -----------------> run --> TABLE
 *     ^                                                    |
 *     |   any key   +--> ASK: one key, then run again or TABLE
 *     +-------------+--> NAME: a second line
 *                   +--> LIST: item by item, a screen at a time
 *                   +--> PLAY: until the performer is idle
 * *   '@' as first character: PROGRAM, a line of requests.h, answered on a plain terminal */
#ifndef EDITOR_H
#define EDITOR_H

#include <stdbool.h>
#include <stdint.h>
#include "keys.h"
#include "requests.h"
#include "page_store.h"
#include "performer.h"
#include "parts.h"
#include "robot.h"
#include "screen.h"
#include "servo_link.h"
#include "session.h"
#include "settings.h"
#include "shell.h"

#define EDITOR_LINE_BYTES 112u    /* a line of a program (requests.h); the screen shows 77 */
#define EDITOR_HISTORY_BYTES 30u
#define EDITOR_NO_PAGE 0xFFu
enum { LATE_TICKS = 64 };         /* half a second: a space that comes so late was meant for what has just ended */

typedef enum {
    EDITOR_TABLE = 0, EDITOR_LINE, EDITOR_ASK, EDITOR_NAME, EDITOR_LIST, EDITOR_PLAY,
    EDITOR_MORE, EDITOR_PROGRAM
} editor_mode_t;

/* What a command handler returns besides SHELL_OK and SHELL_ERR_SAID: the mode that goes on from here. */
enum { EDITOR_TO_ASK = EDITOR_ASK, EDITOR_TO_NAME = EDITOR_NAME, EDITOR_TO_LIST = EDITOR_LIST,
       EDITOR_TO_PLAY = EDITOR_PLAY };

struct editor;
/* Prints item `item` as one line, or nothing. false: there is no such item, the list ends. */
typedef bool (*editor_item_t)(uint8_t item);

/* Small things first: the AVR reaches 63 bytes behind a pointer with one instruction. */
typedef struct editor {
    uint8_t mode;                  /* editor_mode_t */
    uint8_t asked, answered;       /* questions: put by this run, answered with yes */
    uint8_t next_item, lines;      /* of the list being shown */
    uint8_t list_first, list_last; /* pages of LIST and CHECK */
    uint8_t take_page, take_first, take_last; /* steps noted by TAKE */
    uint8_t late_ticks;            /* a play or a list has just ended: a space was meant for it */
    bool step_due;                 /* a step has begun: the row says which when the line has room */
    bool faults_due;               /* something befell a servo: the row says it when the line has room */
    bool broken_off;               /* a servo's fault has ended the last play: the row says so until the next line is run */
    bool swallow;                  /* the rest of a line whose first letter answered a question */
    bool after_cr;                 /* the last byte was CR: a LF now belongs to it */
    uint16_t quiet_since;          /* tick of the last byte */
    shell_args_t args;             /* of the line being run */
    editor_item_t item;            /* of the list being shown */
    const char *notice_P;          /* told once, when the first screen stands; or NULL */
    /* Parts. */
    keys_t keys;
    shell_t shell;
    page_source_t source;          /* the open page from RAM, the others from flash */
    char line[EDITOR_LINE_BYTES];
    char history[EDITOR_HISTORY_BYTES];
} editor_t;

/* The only one, in main.c; see parts.h. The handlers of commands take it from here and not from their context. */
extern editor_t the_editor;

/* After board_start, page_store_init, settings_load, servo_link_scan, performer_init on the parts. text_init is the
 * caller's. */
void editor_init(void);

/* One turn of the main loop: keys, the tick's work, one piece of the screen. true: there is more to do at once. */
bool editor_turn(void);

/* One character of text: what text_init is given calls this. */
void editor_put(char character);

/* One byte from the console. */
void editor_byte(uint8_t byte);

/* ---- for the commands ---- */

/* Questions. true: go on (it was answered, or need not be asked); false: return EDITOR_TO_ASK. */
bool editor_ask(const char *question_P);
bool editor_ask_unsaved(void);

/* What may not wait while something moves: the tick, the bus. */
void editor_serve(void);

/* Begins a list: `title_P` is its first line. Returns EDITOR_TO_LIST. */
uint8_t editor_list(editor_item_t item, const char *title_P);

/* Ends an editing command: tells when it cannot be undone. Returns SHELL_OK. */
uint8_t editor_edited(void);

/* Opens a page: trim, Go Step. */
void editor_open(uint8_t page);

/* The line has been dealt with: back to the table. */
void editor_leave_line(void);

/* A message on the command row while nobody types. */
void editor_message_begin(void);
void editor_message_end(void);

/* Tells on the message row what is with these joints: "No answer: ID 5-7". None: nothing. */
void editor_tell_joints(const char *what_P, uint32_t joints) NOINLINE;

/* Tells on the message row which servos did not answer, and forgets them. */
void editor_tell_failed(void);

#endif
