/* SPDX-License-Identifier: MIT
 * image_source.h - a page_source_t over a motion image in memory, for tests on the PC. */
#ifndef IMAGE_SOURCE_H
#define IMAGE_SOURCE_H

#include "player.h"

typedef struct {
    uint8_t bytes[PAGE_COUNT][PAGE_BYTES];
    unsigned reads;
} image_t;

/* A source over `image`. Every check() validates the page again. */
page_source_t image_source(image_t *image);

/* All pages empty. */
void image_clear(image_t *image);

/* Loads a file of pages; page `first` of the file becomes page 0. Returns false if the file is missing or too short. */
bool image_load(image_t *image, const char *path, unsigned first);

#endif
