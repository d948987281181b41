/* SPDX-License-Identifier: MIT
 * shell.h - line editor (shell_line.c), words and numbers (shell_words.c), command dispatcher (shell.c).
 * Knows no command, no console and no screen: the caller passes bytes and a table of commands, the echo goes through
 * text.h. Used by Play, Edit and Monitor. Main loop only. The caller owns the state and both buffers, so that each image
 * pays only for the length it needs.
 *
 * Keys: BS (0x08) and DEL (0x7F) delete. CR, LF and CR LF each end a line once. Ctrl-A (0x01) and arrow-up replace the line
 * by the one typed before (again: the one before that); arrow-down goes back. Ctrl-C (0x03) and Ctrl-U (0x15) empty the
 * line; in Edit, Ctrl-C leaves it (editor_keys.c). Other escape sequences and control characters have no effect. A lone ESC
 * does not swallow the next key: the rest of a sequence follows at once, a typed key later (shell_quiet). Words are
 * separated by any number of space , . : ; (edit/ORIGINAL.md section 5). Case does not matter. */
#ifndef SHELL_H
#define SHELL_H

#include <stdbool.h>
#include <stdint.h>
#include "compiler.h"

/* The result of a byte. */
typedef enum {
    SHELL_TYPING = 0, /* the line is not complete */
    SHELL_LINE,       /* the line is complete: call shell_split and run it */
    SHELL_REFUSED     /* the line is complete but has a fault: do not run it; report it with shell_print_refusal or
                       * requests_line, then call shell_clear */
} shell_event_t;

typedef struct {
    char *line;             /* the typed text; NUL-terminated once complete */
    char *history;          /* earlier lines, newest first, NUL-terminated; two NULs end it */
    uint8_t line_bytes, history_bytes;
    uint8_t length;         /* characters in `line` */
    uint8_t recalled;       /* how many lines back the recalled line is; 0 = the line being typed */
    uint8_t fault;          /* of the line: SHELL_OK, SHELL_ERR_LOSSY, SHELL_ERR_LONG */
    uint8_t escape;         /* state within an escape sequence */
    bool after_cr;          /* the last byte was CR, so an LF now belongs to it */
} shell_t;

/* Starts with an empty line and an empty history. `line_bytes` includes the NUL. `history` may be NULL with 0 bytes: no
 * recall. The shell keeps using both buffers. */
void shell_init(shell_t *shell, char *line, uint8_t line_bytes, char *history, uint8_t history_bytes);

/* Takes one byte and echoes its effect on the line; BEL for a character that does not fit. Does not echo the end of a line:
 * the image decides where its answer goes. */
shell_event_t shell_byte(shell_t *shell, uint8_t byte);

/* Call after 50 ms without a byte: a pending ESC was the Esc key, and `[` is a character again. */
static inline void shell_quiet(shell_t *shell)
{
    shell->escape = 0;
}

/* Reports `count` bytes lost before the next one. If any were lost, the current line will be SHELL_REFUSED. */
void shell_lose(shell_t *shell, uint8_t count);

/* Prints why a line was refused: "Bytes of this line were lost: nothing was done". */
void shell_print_refusal(uint8_t fault);

/* Clears the line without echo and keeps the history. Call it after running a complete line. */
void shell_clear(shell_t *shell);

/* The range of a number: its name in a sentence, and its bounds. In flash. */
typedef struct {
    const char *name_P;
    int16_t min, max;
} shell_range_t;

/* Range number `range` (1 and above) of the program: ranges.c. */
const shell_range_t *shell_range_P(uint8_t range);

/* The words of a line. */
typedef struct {
    const char *words; /* word 0, NUL, word 1, NUL, ... */
    uint8_t count;     /* word 0 is the command */
    bool hex;          /* numbers without prefix are hexadecimal */
    uint16_t number[2]; /* the first two words after the command, if the table gives their ranges; int16_t if the range has
                         * negative numbers; 0 if absent */
} shell_args_t;

/* Puts the complete line into the history, then splits it in place. The words are valid until shell_clear. Does not set
 * args->number.
 * hex: numbers without prefix are hexadecimal. */
void shell_split(shell_t *shell, bool hex, shell_args_t *args);

/* The same for a line outside a shell: splits these characters in place. */
void shell_words(char *line, bool hex, shell_args_t *args);

/* Word `index`; an empty string when there is none. */
const char *shell_word(const shell_args_t *args, uint8_t index);

/* Whether the word equals `word_P` (in flash, lower case), ignoring case. */
bool shell_word_is(const shell_args_t *args, uint8_t index, const char *word_P);

/* Parses a whole word as a number up to 65535: decimal digits, or 0x and hexadecimal digits (always hexadecimal if `hex`).
 * Prints nothing. false: no such number; *value is unchanged. */
bool shell_parse(const char *word, bool hex, uint16_t *value);

/* Parses `count` (1..4) hexadecimal digits. false: a character is not a digit; *value is undefined. */
bool shell_hex(const char *digits, uint8_t count, uint16_t *value);

/* Prints "Page must be 0..127", with hexadecimal bounds if `hex`. */
void shell_print_range(const char *what_P, int16_t min, int16_t max, bool hex);

/* Parses word `index` as a number within shell_range_P(range), with a minus if the range has negative numbers. Prints
 * nothing. false: *value is unchanged; the handler returns SHELL_ERR_RANGE, and shell_print_range_error prints the range. */
MUST_CHECK bool shell_take(const shell_args_t *args, uint8_t index, uint8_t range, uint16_t *value);
MUST_CHECK bool shell_take_word(const char *word, bool hex, uint8_t range, uint16_t *value);
void shell_print_range_error(void);

#define SHELL_ANY_ARGS 15u

typedef uint8_t (*shell_handler_t)(const shell_args_t *args);

/* One command. Tables of commands are in flash. */
typedef struct {
    const char *text;         /* in flash, lower case: word, space, abbreviation or nothing, space, help:
                               * "play p n|name  plays a page", "law  [exact|classic]", "ver  " */
    shell_handler_t handler;
    uint8_t args;             /* SHELL_ARGS: how many words may follow; SHELL_STILL */
    uint16_t numbers;         /* ranges of the first two, SHELL_BOTH; 0: the handler checks them */
} shell_command_t;

/* min 0..7, max 0..14; max SHELL_ANY_ARGS: no upper limit. */
#define SHELL_ARGS(min, max) ((uint8_t)((min) << 4 | (max)))

/* Flag in `args`: refused while something moves. */
#define SHELL_STILL 0x80u

/* The ranges of two words; 0: not a number. */
#define SHELL_BOTH(first, second) ((uint16_t)((first) | (second) << 8))

/* Columns of a line of help. An image for narrow terminals may define them smaller. */
#ifndef SHELL_WORD_COLUMNS
#define SHELL_WORD_COLUMNS 10u
#define SHELL_SHORT_COLUMNS 5u
#endif

/* The result of a command: what its handler returned, or why it was not called. */
enum {
    SHELL_OK = 0,
    SHELL_ERR_REPORTED = 1,  /* for handlers: failed, and the reason has been printed */
    SHELL_ERR_LOSSY = 250,   /* bytes of the line were lost: shell_print_refusal */
    SHELL_ERR_LONG,          /* the line is too long: shell_print_refusal */
    SHELL_ERR_MOVING,  /* not while something moves. This one and the next three print nothing */
    SHELL_ERR_RANGE,         /* shell_take returned false, just now: so shell_print_range_error prints that range */
    SHELL_ERR_UNKNOWN,       /* no such word */
    SHELL_ERR_COUNT          /* too few or too many words */
};

/* Finds word 0 among `count` commands, checks the number of words and the ranges, and calls the handler.
 * moving: something is moving. Returns the handler's result, which may be a value of its own, 2..249. SHELL_OK for an empty
 * line. */
uint8_t shell_run(const shell_command_t *table_P, uint8_t count, shell_args_t *args, bool moving);

/* The command whose word or abbreviation is word `index`, or NULL. */
const shell_command_t *shell_find(const shell_command_t *table_P, uint8_t count, const shell_args_t *args,
                                  uint8_t index);

/* Prints one line of help: word, abbreviation, help text, CR LF. */
void shell_print_help(const shell_command_t *command_P);

#endif
