/* SPDX-License-Identifier: MIT
 * app_record.h - how an application image describes itself: 16 bytes at MEM_APP_RECORD, right after the vectors.
 * The image is linked with the magic and 0xFF; tools/dev/app_record fills in the rest. The boot loader starts an image
 * with a record only when length and CRC match. It starts an image without the magic unchecked. A magic with some bits
 * turned to 1 still counts as a record, because a power cut can tear the first page; the CRC then fails. So a foreign
 * program must extend beyond the record, as every program with a full vector table does. */
#ifndef APP_RECORD_H
#define APP_RECORD_H

#include <stdint.h>
#include "compiler.h"
#include "memory_map.h"

#define APP_RECORD_MAGIC { 'M', '5', '1', '2' }
#define APP_RECORD_LAYOUT 1u

enum { APP_RECORD_CM5 = 1, APP_RECORD_CM2 = 2, APP_RECORD_PC = 3 }; /* board; PC: a program of hal/host */
enum { APP_RECORD_PLAY = 1, APP_RECORD_EDIT = 2, APP_RECORD_OTHER = 255 };  /* kind */

/* Little-endian, no padding on either side. */
typedef struct {
    char magic[4];
    uint32_t length_bytes;   /* the image is [0, length_bytes), record included; even, <= MEM_APP_END */
    uint16_t crc16;          /* crc16.h over the whole image, with these two bytes as 0xFF 0xFF */
    uint8_t board;           /* APP_RECORD_CM5, ... */
    uint8_t kind;            /* APP_RECORD_PLAY, ... */
    uint8_t version[3];      /* major, minor, patch */
    uint8_t layout;          /* APP_RECORD_LAYOUT */
} app_record_t;
STATIC_ASSERT(sizeof(app_record_t) == MEM_APP_RECORD_BYTES, "the linker scripts leave 16 bytes");

/* Offsets in layout 1, for programs that patch or check an image. */
#define APP_RECORD_AT_LENGTH 4u
#define APP_RECORD_AT_CRC 8u

/* The record as the post-link step expects it. One file of each application defines it (board.c). */
#define APP_RECORD_UNFILLED { APP_RECORD_MAGIC, 0xFFFFFFFFul, 0xFFFFu, 0xFF, 0xFF, { 0xFF, 0xFF, 0xFF }, 0xFF }

#endif
