/* SPDX-License-Identifier: MIT
 * fuzz_pages.h - pages 1..6 made from an input, for the harnesses that play them. Other pages read as erased flash. */
#ifndef FUZZ_PAGES_H
#define FUZZ_PAGES_H

#include "fuzz.h"
#include "page.h"
#include "page.h"

#define FUZZ_PAGES 6u

extern uint8_t fuzz_pages[FUZZ_PAGES + 1][PAGE_BYTES];   /* page 0 stays zero */
extern const page_source_t fuzz_pages_source;            /* asserts that reads stay within a page */

/* Makes all six pages. For each page the input holds an options byte, 15 header bytes, and for each of its steps
 * pause, time and four words (joints 0, 1, 17, 30). Three bits of the options select the kind: 0..4 sealed and in
 * range, 5..6 sealed with any contents, 7 with a checksum from the input (one byte more). */
void fuzz_pages_make(fuzz_t *fuzz);

/* Changes a byte of a page. Seals the page if it was good before. */
void fuzz_pages_set(uint8_t page, uint8_t at, uint8_t byte);

#endif
