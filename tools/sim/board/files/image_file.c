/* SPDX-License-Identifier: MIT */
#include "image_file.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "elf_image.h"
#include "intel_hex.h"

static image_status_t read_binary(FILE *file, uint32_t address, image_t *image)
{
    uint8_t block[4096];
    size_t count;
    while ((count = fread(block, 1, sizeof block, file)) > 0) {
        if (!image_put(image, address, block, count)) {
            return IMAGE_RANGE;
        }
        address += (uint32_t)count;
    }
    return IMAGE_OK;
}

static bool ends_in(const char *path, const char *suffix)
{
    size_t length = strlen(path), tail = strlen(suffix);
    return length > tail && strcasecmp(path + length - tail, suffix) == 0;
}

image_status_t image_file_read(const char *path, uint32_t address, image_t *image)
{
    memset(image->used, 0, image->size * sizeof *image->used);
    FILE *file = fopen(path, "rb");
    if (!file) {
        return IMAGE_NO_FILE;
    }
    bool hex = ends_in(path, ".hex") || ends_in(path, ".ihex");
    image_status_t status = hex                     ? intel_hex_read(file, image)
                            : ends_in(path, ".elf") ? elf_image_read(file, image)
                                                    : read_binary(file, address, image);
    fclose(file);
    return status;
}
