/* SPDX-License-Identifier: MIT
 * channel.h - the programs' channel: one control byte hands the line after it to requests, in every mode of an image.
 * What a person types has its own buffer and goes on where it was.
 *
 *     0x1E @where 394C CR                  the request; its last four characters are the CRC-16 (crc16.h) of those before
 *     0x1E @where state=idle ... OK CR LF  the answer, and likewise each line of a @watch
 *
 * Knows no screen and no console: bytes in, text (text.h) out. While channel_is_printing an image lets its own columns and
 * rows be: the terminal does not show what is for the channel. PROTOCOL.md says why this byte. Main loop only. One instance;
 * RAM: the line and 3 bytes. */
#ifndef CHANNEL_H
#define CHANNEL_H

#include <stdbool.h>
#include <stdint.h>

#define CHANNEL_BEGIN 0x1Eu         /* ASCII: record separator */
#define CHANNEL_LINE_CHARS 110u     /* of a request, with its CRC */

/* What a byte was. */
typedef enum {
    CHANNEL_NONE = 0,   /* a person's */
    CHANNEL_PART,       /* of a request */
    CHANNEL_LINE        /* the end of one: call requests_answer_channel */
} channel_event_t;

/* Forgets what has come. */
void channel_init(void);

/* Takes one byte. */
channel_event_t channel_byte(uint8_t byte);

/* Whether a request is on its way. */
bool channel_is_open(void);

/* Whether the end of a request does not come: 250 ms without a byte. Then call requests_answer_channel. */
bool channel_is_cut_off(void);

/* Ends the request and returns its line without the CRC, good until the next byte. fault: SHELL_OK; or SHELL_ERR_LOSSY,
 * because the CRC does not fit. */
char *channel_take(uint8_t *fault);

/* What is printed between these two goes to the channel. */
void channel_print_begin(void);
void channel_print_end(void);
bool channel_is_printing(void);

#endif
