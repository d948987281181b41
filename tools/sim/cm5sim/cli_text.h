/* SPDX-License-Identifier: MIT
 * cli_text.h - small words of the command line and the script language: times, ranges, RC keys, quoted text. */
#ifndef CLI_TEXT_H
#define CLI_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* "500ms", "2s", "1.5s", "20us", "3ticks" (128 to a second), "2min", "100cycles" -> cycles of 16 MHz.
 * A bare 0 is a time too; false for anything else. */
bool cli_duration(const char *text, uint64_t *cycles);

/* A whole decimal or 0x number within low..high. */
bool cli_number(const char *text, long low, long high, long *value);

/* Keys of the remote joined by '+': U D L R 1..6, or 0 for none -> the word it sends (REMOTE.md). */
bool cli_rc_keys(const char *text, uint16_t *word);

/* The six bytes of a remote packet. */
#define CLI_RC_BYTES 6
void cli_rc_packet(uint16_t word, uint8_t packet[CLI_RC_BYTES]);

/* One word of a script line. */
typedef struct {
    char *text; /* zero-terminated; quoted text may hold zeros: use length */
    size_t length;
    bool quoted;
} cli_word_t;

/* Splits line in place at blanks. "quoted text" knows \r \n \t \e \0 \\ \" \xHH; '#' begins a comment.
 * Returns the number of words, or -1 with *error set. */
int cli_split(char *line, cli_word_t *words, int max_words, const char **error);

#endif
