/* SPDX-License-Identifier: MIT
 * channel.h - the channel for programs: after one control byte, the rest of the line is a request, in every mode of an
 * image. What a person types has its own buffer and is not disturbed.
 *
 *     0x1E @where 394C CR                  the request; its last four characters are the CRC-16 (crc16.h) of those before
 *     0x1E @where state=idle ... OK CR LF  the answer, and likewise each line of a @watch
 *
 * Knows no screen and no console: bytes in, text (text.h) out. While channel_is_printing, an image does not track its
 * cursor, because the terminal does not show channel text. PROTOCOL.md explains the choice of the byte. Main loop only. One
 * instance; RAM: the line and 3 bytes. */
#ifndef CHANNEL_H
#define CHANNEL_H

#include <stdbool.h>
#include <stdint.h>

#define CHANNEL_BEGIN 0x1Eu         /* ASCII: record separator */
#define CHANNEL_LINE_CHARS 110u     /* of a request, including its CRC */

/* What a byte belongs to. */
typedef enum {
    CHANNEL_NONE = 0,   /* a person's typing */
    CHANNEL_PART,       /* a request */
    CHANNEL_LINE        /* the end of a request: call requests_answer_channel */
} channel_event_t;

/* Drops what was received. */
void channel_init(void);

/* Takes one byte. */
channel_event_t channel_byte(uint8_t byte);

/* Whether a request has begun. */
bool channel_is_open(void);

/* Whether an unfinished request has been silent for 250 ms. Then call requests_answer_channel. */
bool channel_is_cut_off(void);

/* The line of the request so far. Before channel_take it ends in the CRC, if that came. */
const char *channel_line(void);

/* Ends the request and returns its line without the CRC, valid until the next byte. fault: SHELL_OK, or SHELL_ERR_LOSSY
 * if the CRC is wrong. */
char *channel_take(uint8_t *fault);

/* Text printed between these two goes to the channel. */
void channel_print_begin(void);
void channel_print_end(void);
bool channel_is_printing(void);

#endif
