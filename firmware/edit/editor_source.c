/* SPDX-License-Identifier: MIT
 * editor_source.c - where the performer takes pages from: the open one from RAM, the others from flash. */
#include <string.h>
#include "editor_parts.h"
#include "parts.h"
#include "session.h"

static void source_read(void *context __attribute__((unused)), uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    if (page == the_session.page) {
        memcpy(to, &the_session.cells[offset], count);
    } else {
        page_store_read(page, offset, to, count);
    }
}

static uint8_t source_check(void *context __attribute__((unused)), uint8_t page)
{
    return page == the_session.page ? (uint8_t)session_check() : (uint8_t)page_store_check(&the_pages, page);
}

const page_source_t editor_source = { NULL, source_read, source_check };
