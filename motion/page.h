/* SPDX-License-Identifier: MIT
 * page.h - the 512-byte motion page: layout, checks, field access; where pages come from.
 * Pure: no flash, no registers, no I/O. Callable from anywhere. No RAM of its own.
 * PAGE_FORMAT.md is the specification, with a worked hex dump. */
#ifndef PAGE_H
#define PAGE_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include "compiler.h"
#include "target.h"

#define PAGE_BYTES 512u
#define PAGE_COUNT TARGET_MOTION_PAGES /* 128 or 256; page 0 holds the trim and, as a link, means "no page" */
#define PAGE_JOINTS 31u        /* joint = servo ID 0..30 */
#define PAGE_STEPS 7u
#define PAGE_STEP_BYTES 64u
#define PAGE_NAME_BYTES 14u    /* 13 characters and a NUL */

/* Byte offsets in the header (block 0). */
enum {
    PAGE_AT_NAME = 0,
    PAGE_AT_PLAY_COUNT = 15,
    PAGE_AT_SCHEDULE = 16,
    PAGE_AT_BLEND_RIGHT = 17,  /* partner page of shape.h; 0: none */
    PAGE_AT_BLEND_LEFT = 18,
    PAGE_AT_STEPS = 20,
    PAGE_AT_PLAY_CODE = 21,
    PAGE_AT_SPEED = 22,
    PAGE_AT_DXL_SETUP = 23,
    PAGE_AT_ACCEL_TIME = 24,
    PAGE_AT_NEXT_PAGE = 25,
    PAGE_AT_EXIT_PAGE = 26,
    PAGE_AT_LINKED1_PAGE = 27,
    PAGE_AT_LINKED1_CODE = 28,
    PAGE_AT_LINKED2_PAGE = 29,
    PAGE_AT_LINKED2_CODE = 30,
    PAGE_AT_CHECKSUM = 31,
    PAGE_AT_COMPLIANCE = 32,   /* + ID */
    PAGE_AT_STEP0 = 64         /* + 64 * step */
};
/* Byte offsets in a step. A position word is at 2 * ID. */
enum { PAGE_STEP_AT_PAUSE = 62, PAGE_STEP_AT_SPEED = 63 };

#define PAGE_SCHEDULE_SPEED 0x00u
#define PAGE_SCHEDULE_TIME 0x0Au
#define PAGE_SPEED_NOMINAL 32u
#define PAGE_ACCEL_DEFAULT 32u
#define PAGE_COMPLIANCE_DEFAULT 0x55u
#define PAGE_CHECKSUM_SUM 0xFFu   /* 8-bit sum of all 512 bytes of a good page */

#define PAGE_POS_MAX 1023u
#define PAGE_POS_MIDDLE 512u
#define PAGE_POS_UNUSED 0x4000u   /* flag: joint not used in this step */
#define PAGE_POS_TORQUE_OFF 0x2000u /* flag: torque off (work pose only; never in a page we store) */

/* What is wrong with a page; the first fault found, in this order. */
typedef enum {
    PAGE_OK = 0,
    PAGE_ERR_CHECKSUM,   /* sum of all bytes is not 0xFF */
    PAGE_ERR_STEPS,      /* more than 7 steps */
    PAGE_ERR_SCHEDULE,   /* neither 0 nor 0x0A */
    PAGE_ERR_SPEED,      /* PAGE_SPEED is 0 */
    PAGE_ERR_LINK,       /* never returned: a link beyond the pages counts as 0 (LAWS.md). Keeps the other numbers */
    PAGE_ERR_POSITION,   /* a position of a used step is above 1023 and has neither flag (0x4000, 0x2000) */
    PAGE_EMPTY           /* valid, but without action: page_is_playable. Ends a play; page_check never returns it */
} page_status_t;

/* 8-bit sum of `count` bytes, added to `sum`: pages are summed in pieces as they are read. */
uint8_t page_sum(uint8_t sum, const uint8_t *bytes, uint16_t count);

/* Checks a whole page: the sum, the header, the positions of the steps that its header counts. A caller that reads the page
 * in pieces gets the same result from page_sum, page_check_header and page_check_step, in this order. */
page_status_t page_check(const uint8_t page[PAGE_BYTES]);
page_status_t page_check_header(const uint8_t header[PAGE_STEP_BYTES]);
page_status_t page_check_step(const uint8_t step[PAGE_STEP_BYTES]);

/* Sets byte 31 so that the page sums to 0xFF. */
void page_seal(uint8_t page[PAGE_BYTES]) NOINLINE;

/* The empty page of PAGE_FORMAT.md, sealed. */
void page_clear(uint8_t page[PAGE_BYTES]);

/* Whether there is a page of this number. It is wider than a byte, because a PC has 256 pages. */
static inline bool page_is_there(uint16_t page)
{
    return page < PAGE_COUNT;
}

/* The little-endian word at `at`. All our machines are little-endian too (tests/unit/test_page.c). */
static inline uint16_t page_word(const uint8_t *at)
{
    uint16_t word;
    memcpy(&word, at, sizeof word);
    return word;
}

/* Position word of `joint` in `step` (0..6). */
uint16_t page_pos(const uint8_t *page, uint8_t step, uint8_t joint);
void page_set_pos(uint8_t *page, uint8_t step, uint8_t joint, uint16_t word);

/* true when the word drives its joint: neither flag set. */
static inline bool page_pos_is_used(uint16_t word)
{
    uint8_t flags = (uint8_t)(word >> 8);
    flags &= (PAGE_POS_UNUSED | PAGE_POS_TORQUE_OFF) >> 8;
    return flags == 0;
}

/* Adds a page to a set of pages. false: it is in the set already. */
bool page_set_add(uint8_t set[PAGE_COUNT / 8], uint8_t page);

/* true when the header has an action: steps and play count are not 0. */
bool page_is_playable(const uint8_t *header);

/* Where pages come from: flash on the robot, an array in a test. Both calls must be cheap: a new step makes up to four
 * reads of up to 64 bytes, a shaped one about fifteen, and each page that is passed over one more. */
typedef struct {
    void *context;
    /* Copies `count` bytes at byte `offset` of page `page` (0..PAGE_COUNT - 1). */
    void (*read)(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count);
    /* page_status_t of the whole page, from a cache. */
    uint8_t (*check)(void *context, uint8_t page);
} page_source_t;

#endif
