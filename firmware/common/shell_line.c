/* SPDX-License-Identifier: MIT
 * shell_line.c - the line editor and its history. */
#include "shell.h"

#include <stddef.h>
#include <string.h>
#include "text.h"

enum {
    KEY_RECALL = 0x01, /* Ctrl-A */
    KEY_CTRL_C = 0x03,
    KEY_BEL = 0x07,
    KEY_BS = 0x08,
    KEY_LF = 0x0A,
    KEY_CR = 0x0D,
    KEY_CTRL_U = 0x15,
    KEY_ESC = 0x1B,
    KEY_DEL = 0x7F
};

/*            ESC            [ or O            0x40..0x7E
 *  ESC_NONE -----> ESC_BEGUN -----> ESC_BODY -----------> ESC_NONE
 *                     | any other byte                ^ (parameters stay in ESC_BODY)
 *                     +--> ESC_NONE, and the byte takes effect: the ESC was the Esc key
 *  shell_quiet: ESC_NONE */
enum { ESC_NONE = 0, ESC_BEGUN, ESC_BODY };

void shell_init(shell_t *shell, char *line, uint8_t line_bytes, char *history, uint8_t history_bytes)
{
    memset(shell, 0, sizeof *shell);
    shell->line = line;
    shell->line_bytes = line_bytes;
    shell->history = history;
    shell->history_bytes = history_bytes;
    line[0] = '\0';
    if (history_bytes > 0) {
        memset(history, 0, history_bytes);
    }
}

void shell_clear(shell_t *shell)
{
    shell->length = 0;
    shell->recalled = 0;
    shell->fault = SHELL_OK;
    shell->line[0] = '\0';
}

void shell_lose(shell_t *shell, uint8_t count)
{
    if (count != 0) {
        shell->fault = SHELL_ERR_LOSSY;
    }
}

void shell_print_refusal(uint8_t fault)
{
    text_P(fault == SHELL_ERR_LOSSY ? TEXT_P("Bytes of this line were lost") : TEXT_P("The line is too long"));
    TEXT(": nothing was done");
}

static void rub_out(shell_t *shell)
{
    if (shell->length > 0) {
        shell->length--;
        text_put(KEY_BS);
        text_put(' ');
        text_put(KEY_BS);
    }
}

static void empty_line(shell_t *shell)
{
    while (shell->length > 0) {
        rub_out(shell);
    }
    shell->fault = SHELL_OK;
}

static void type(shell_t *shell, char character)
{
    if (shell->length + 1u >= shell->line_bytes) {
        if (shell->fault == SHELL_OK) {
            shell->fault = SHELL_ERR_LONG;
        }
        text_put(KEY_BEL);
        return;
    }
    shell->line[shell->length++] = character;
    text_put(character);
}

/* The line that was typed `back` lines ago (1 = the last one), or NULL. */
static const char *history_line(const shell_t *shell, uint8_t back)
{
    const char *line = shell->history;
    if (shell->history_bytes == 0) {
        return NULL;
    }
    while (*line != '\0') {
        if (--back == 0) {
            return line;
        }
        line += strlen(line) + 1;
    }
    return NULL;
}

/* Replaces the line by the one typed `back` lines ago; 0 empties it. No effect beyond the oldest line. */
static void recall(shell_t *shell, uint8_t back)
{
    const char *line = back == 0 ? "" : history_line(shell, back);
    if (line == NULL) {
        return;
    }
    empty_line(shell);
    shell->recalled = back;
    while (*line != '\0') {
        type(shell, *line++);
    }
}

/* Puts the line at the front of the history. Drops the oldest line if it no longer fits completely. */
static void remember(shell_t *shell)
{
    const uint8_t bytes = shell->length + 1;
    if (shell->length == 0 || bytes + 1u > shell->history_bytes) {
        return;
    }
    const char *last = history_line(shell, 1);
    if (last != NULL && strcmp(last, shell->line) == 0) {
        return;
    }
    memmove(shell->history + bytes, shell->history, shell->history_bytes - bytes);
    memcpy(shell->history, shell->line, bytes);
    /* Two NULs end the list. If the oldest line was cut, it is erased back to the NUL of the line before it. */
    char *end = shell->history + shell->history_bytes;
    do {
        *--end = '\0';
    } while (end[-1] != '\0');
}

/* true: the byte belongs to an escape sequence. A control character ends the sequence and takes effect. */
static bool swallow_escape(shell_t *shell, uint8_t byte)
{
    if (shell->escape == ESC_BEGUN && (byte == '[' || byte == 'O')) {
        shell->escape = ESC_BODY;
        return true;
    }
    if (shell->escape != ESC_BODY || byte < 0x20) {
        shell->escape = byte == KEY_ESC ? ESC_BEGUN : ESC_NONE;
        return byte == KEY_ESC;
    }
    if (byte >= 0x40) {
        shell->escape = ESC_NONE;
        if (byte == 'A') {
            recall(shell, shell->recalled + 1);
        } else if (byte == 'B' && shell->recalled > 0) {
            recall(shell, shell->recalled - 1);
        }
    }
    return true;
}

static void control_key(shell_t *shell, uint8_t byte)
{
    if (byte == KEY_BS || byte == KEY_DEL) {
        rub_out(shell);
    } else if (byte == KEY_RECALL) {
        recall(shell, shell->recalled + 1);
    } else if (byte == KEY_CTRL_C || byte == KEY_CTRL_U) {
        empty_line(shell);
    }
}

shell_event_t shell_byte(shell_t *shell, uint8_t byte)
{
    const bool lf_of_cr = byte == KEY_LF && shell->after_cr;
    shell->after_cr = byte == KEY_CR;
    if (lf_of_cr || swallow_escape(shell, byte)) {
        return SHELL_TYPING;
    }
    if (byte == KEY_CR || byte == KEY_LF) {
        shell->line[shell->length] = '\0';
        return shell->fault != SHELL_OK ? SHELL_REFUSED : SHELL_LINE;
    }
    if (byte < 0x20 || byte >= KEY_DEL) {
        control_key(shell, byte);
    } else {
        type(shell, (char)byte);
    }
    return SHELL_TYPING;
}

/* ---- a complete line ---- */

static bool is_separator(char character)
{
    return character == ' ' || character == ',' || character == '.' || character == ':' || character == ';';
}

void shell_split(shell_t *shell, bool hex, shell_args_t *args)
{
    remember(shell);
    shell_words(shell->line, hex, args);
}

void shell_words(char *line, bool hex, shell_args_t *args)
{
    args->words = line;
    args->count = 0;
    args->hex = hex;
    char *to = line;
    bool inside = false;
    for (const char *from = line; *from != '\0'; from++) {
        if (!is_separator(*from)) {
            args->count = (uint8_t)(args->count + (inside ? 0 : 1));
            inside = true;
            *to++ = *from;
        } else if (inside) {
            inside = false;
            *to++ = '\0';
        }
    }
    *to = '\0';
}
