/* SPDX-License-Identifier: MIT
 * frame.h - receives one frame of the block protocol (BLOCK_PROTOCOL.md). Pure; tested on the PC; callable from anywhere.
 *
 *   0xA5 | command | number | n | 2 n bytes of body | CRC-16 high, low      CRC over command .. body (crc16.h)
 *
 * The CRC of a good frame, including its own two bytes, is 0. */
#ifndef FRAME_H
#define FRAME_H

#include <stdbool.h>
#include <stdint.h>

#define FRAME_REQUEST 0xA5u
#define FRAME_ANSWER 0x5Au
#define FRAME_HEAD_BYTES 3u
#define FRAME_BODY_MAX 258u
#define FRAME_BYTES_MAX (FRAME_HEAD_BYTES + FRAME_BODY_MAX + 2u)
enum { FRAME_AT_COMMAND, FRAME_AT_NUMBER, FRAME_AT_COUNT, FRAME_AT_BODY };

typedef struct {
    uint8_t *bytes; /* the caller's, FRAME_BYTES_MAX: command, number, n, body, CRC */
    uint16_t at;    /* bytes of the frame received; 0xFFFF while waiting for FRAME_REQUEST */
    uint16_t crc;   /* of these bytes */
} frame_t;

typedef enum {
    FRAME_MORE = 0, /* nothing to do yet */
    FRAME_GOOD,     /* bytes[] holds a frame */
    FRAME_BAD       /* CRC or count wrong: dropped; waits for FRAME_REQUEST again */
} frame_status_t;

/* Begins to wait for FRAME_REQUEST. */
void frame_init(frame_t *frame, uint8_t *bytes);

/* true between FRAME_REQUEST and the end of the CRC. */
bool frame_is_open(const frame_t *frame);

/* Takes the next byte. After FRAME_GOOD, bytes[] is valid until the next call. */
frame_status_t frame_feed(frame_t *frame, uint8_t byte);

#endif
