/* SPDX-License-Identifier: MIT */
#include "frame.h"

#include "crc16.h"

#define HUNTING 0xFFFFu

void frame_init(frame_t *frame, uint8_t *bytes)
{
    frame->bytes = bytes;
    frame->at = HUNTING;
}

bool frame_is_open(const frame_t *frame)
{
    return frame->at != HUNTING;
}

frame_status_t frame_feed(frame_t *frame, uint8_t byte)
{
    if (frame->at == HUNTING) {
        if (byte == FRAME_REQUEST) {
            frame->at = 0;
            frame->crc = CRC16_START;
        }
        return FRAME_MORE;
    }
    uint16_t at = frame->at;
    frame->bytes[at++] = byte;
    frame->crc = crc16_byte(frame->crc, byte);
    frame->at = at;
    uint8_t count = frame->bytes[FRAME_AT_COUNT];
    if (at < FRAME_HEAD_BYTES || (count <= FRAME_BODY_MAX / 2 && at < FRAME_HEAD_BYTES + 2u * count + 2u)) {
        return FRAME_MORE;
    }
    frame->at = HUNTING;
    return count <= FRAME_BODY_MAX / 2 && frame->crc == 0 ? FRAME_GOOD : FRAME_BAD;
}
