/* SPDX-License-Identifier: MIT
 * shell.h - line editor, tokenizer, number parser and command dispatcher: a byte in, text out.
 * Knows no command, no console and no screen: bytes are handed in, the echo goes through text.h, the commands are a
 * table of the image. Used by Play, Edit and Edit's bus monitor. Main loop only. Caller-owned state; the two buffers
 * are the caller's too, so that each image pays for the length it needs.
 *
 * Keys: BS (0x08) and DEL (0x7F) delete; CR, LF and CR LF end a line once; Ctrl-A (0x01) and arrow-up put the line
 * typed before in place of this one (again: the one before that), arrow-down goes back; Ctrl-U (0x15) empties the
 * line; other escape sequences and control characters are swallowed whole. Words are separated by any number of
 * space , . : ; (editor-original.md section 5). Case does not matter. */
#ifndef SHELL_H
#define SHELL_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"

/* What a byte completed. */
typedef enum {
    SHELL_TYPING = 0, /* nothing yet */
    SHELL_LINE,       /* a line is complete: shell_split, then run it */
    SHELL_TOO_LONG    /* a line is complete but did not fit: it must not be run; shell_clear */
} shell_event_t;

typedef struct {
    char *line;             /* what is typed; NUL-terminated once complete */
    char *history;          /* earlier lines, newest first, each with its NUL; two NULs end it */
    uint8_t line_bytes, history_bytes;
    uint8_t length;         /* characters in `line` */
    uint8_t recalled;       /* how many lines back the recall stands; 0 = the line being typed */
    uint8_t escape;         /* state of the escape-sequence swallower */
    bool after_cr;          /* the last byte was CR: an LF now belongs to it */
    bool too_long;          /* characters were refused */
} shell_t;

/* Empty line, empty history. `line_bytes` counts the NUL (a line holds one character less); `history` may be NULL
 * with 0 bytes: no recall. Both buffers stay in use. */
void shell_init(shell_t *shell, char *line, uint8_t line_bytes, char *history, uint8_t history_bytes);

/* Takes one byte and echoes what it does to the line (a character that no longer fits is answered with BEL). The end of
 * a line is not echoed: the image decides where its answer stands. */
shell_event_t shell_byte(shell_t *shell, uint8_t byte);

/* Drops what is typed, without echo; the history stays. Call it when a complete line has been dealt with. */
void shell_clear(shell_t *shell);

/* What a number may be: its name in a sentence, and its bounds. In flash. */
typedef struct {
    const char *name_P;
    int16_t min, max;
} shell_range_t;

/* The program's: what the numbers of its commands may be, 1 and above (ranges.h). */
const shell_range_t *shell_range_P(uint8_t range);

/* The words of a line. */
typedef struct {
    const char *words; /* word 0, NUL, word 1, NUL, ... */
    uint8_t count;     /* word 0 is the command */
    bool hex;          /* numbers without prefix are hexadecimal */
    uint16_t number[2]; /* the first two words behind the command, where the table says what they are (int16_t where that may
                         * be negative); 0 when not given */
} shell_args_t;

/* Puts the complete line into the history, then cuts it up in place. The words live until shell_clear.
 * `hex`: how plain numbers in this line are meant. */
shell_args_t shell_split(shell_t *shell, bool hex);

/* Word `index`; an empty string when there is none. */
const char *shell_word(const shell_args_t *args, uint8_t index);

/* true when the word equals `word_P` (in flash, lower case) but for case. */
bool shell_word_is(const shell_args_t *args, uint8_t index, const char *word_P);

/* A whole word as a number: decimal digits or 0x and hexadecimal digits (hexadecimal either way when `hex`), at most
 * 65535. false: *value is untouched. Says nothing. */
bool shell_parse(const char *word, bool hex, uint16_t *value);

/* `count` (1..4) hexadecimal digits as a number. false: there are fewer, or one is none. */
bool shell_hex(const char *digits, uint8_t count, uint16_t *value);

/* "Page must be 0..127"; bounds in hexadecimal when `hex`. */
void shell_print_range(const char *what_P, int16_t min, int16_t max, bool hex);

/* Word `index` as a number within the bounds of shell_range_P(range); a minus may stand in front where they allow it. Says
 * nothing: false, with *value untouched, is for handlers to return as SHELL_ERR_RANGE, and shell_print_broken says then
 * which range it was. */
MUST_CHECK bool shell_take(const shell_args_t *args, uint8_t index, uint8_t range, uint16_t *value);
void shell_print_broken(void);

#define SHELL_ANY_ARGS 15u

typedef uint8_t (*shell_handler_t)(void *context, const shell_args_t *args);

/* One command. Tables of these stand in flash. */
typedef struct {
    const char *text;         /* in flash: word, abbreviation or nothing, help, each (but the last) with a space behind:
                               * "play p n|name  plays a page", "law  [exact|classic]", "ver  ". Lower case. */
    shell_handler_t handler;
    uint8_t args;             /* SHELL_ARGS: how many words may follow; SHELL_STILL */
    uint16_t numbers;         /* what the first two of them are, SHELL_BOTH; 0: the handler looks itself */
} shell_command_t;

/* min 0..7, max 0..14; max SHELL_ANY_ARGS: no upper limit. */
#define SHELL_ARGS(min, max) ((uint8_t)((min) << 4 | (max)))

/* Not while something moves. This is the one place that says so of a command. */
#define SHELL_STILL 0x80u

/* For shell_range_P; 0: not a number. */
#define SHELL_BOTH(first, second) ((uint16_t)((first) | (second) << 8))

/* Columns of a line of help. An image for narrow terminals may define them smaller. */
#ifndef SHELL_WORD_COLUMNS
#define SHELL_WORD_COLUMNS 10u
#define SHELL_SHORT_COLUMNS 5u
#endif

/* Outcome of a command: what the handler returned, or the two faults found before it was called. */
enum {
    SHELL_OK = 0,
    SHELL_ERR_SAID = 1,     /* for handlers: failed, and the reason has been printed */
    SHELL_ERR_MOVING = 252,  /* not while something moves. These four print nothing */
    SHELL_ERR_RANGE,         /* a number is none, or out of its range: shell_print_broken */
    SHELL_ERR_UNKNOWN,       /* no such word */
    SHELL_ERR_COUNT          /* too few or too many words */
};

/* Looks word 0 up among `count` commands, checks what the table says of it, and calls its handler with `context`. `moving`:
 * something moves now. An empty line is SHELL_OK. Handlers may return values of their own, 2..251, which come back as they
 * are. */
uint8_t shell_run(const shell_command_t *table_P, uint8_t count, void *context, shell_args_t *args, bool moving);

/* The table's entry for word `index` (or its abbreviation), or NULL: for HELP of one command. */
const shell_command_t *shell_find(const shell_command_t *table_P, uint8_t count, const shell_args_t *args,
                                  uint8_t index);

/* Prints one line of help: word, abbreviation, help text, CR LF. */
void shell_print_help(const shell_command_t *command_P);

#endif
