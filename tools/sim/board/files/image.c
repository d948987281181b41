/* SPDX-License-Identifier: MIT */
#include "image.h"

#include <string.h>

bool image_put(image_t *image, uint32_t address, const uint8_t *data, size_t count)
{
    if (address > image->size || count > image->size - address) {
        return false;
    }
    memcpy(image->bytes + address, data, count);
    memset(image->used + address, true, count);
    return true;
}

const char *image_text(image_status_t status)
{
    static const char *const texts[] = { "read", "cannot be opened", "is not an image of its kind",
                                         "has a wrong checksum", "goes beyond the flash", "has no end record" };
    return texts[status];
}
