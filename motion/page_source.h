/* SPDX-License-Identifier: MIT
 * page_source.h - the source of motion pages: flash on the robot, an array in a test. */
#ifndef PAGE_SOURCE_H
#define PAGE_SOURCE_H

#include <stdint.h>

/* Both calls must be cheap: a tick of a play makes up to six reads of up to 64 bytes. */
typedef struct {
    void *context;
    /* Copies `count` bytes at byte `offset` of page `page` (0..127). */
    void (*read)(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count);
    /* page_status_t of the whole page, from a cache. */
    uint8_t (*check)(void *context, uint8_t page);
} page_source_t;

#endif
