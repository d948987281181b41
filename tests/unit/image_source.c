/* SPDX-License-Identifier: MIT */
#include "image_source.h"
#include <stdio.h>
#include <string.h>

static void read_page(void *context, uint8_t page, uint16_t offset, void *to, uint8_t count)
{
    image_t *image = context;
    image->reads++;
    memcpy(to, &image->bytes[page][offset], count);
}

static uint8_t check_page(void *context, uint8_t page)
{
    const image_t *image = context;
    return (uint8_t)page_check(image->bytes[page]);
}

page_source_t image_source(image_t *image)
{
    return (page_source_t){.context = image, .read = read_page, .check = check_page};
}

void image_clear(image_t *image)
{
    for (unsigned page = 0; page < PAGE_COUNT; page++) {
        page_clear(image->bytes[page]);
    }
}

bool image_load(image_t *image, const char *path, unsigned first)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return false;
    }
    bool good = fseek(file, (long)(first * PAGE_BYTES), SEEK_SET) == 0 &&
                fread(image->bytes, sizeof image->bytes, 1, file) == 1;
    fclose(file);
    return good;
}
