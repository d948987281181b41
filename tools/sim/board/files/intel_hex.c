/* SPDX-License-Identifier: MIT */
#include "intel_hex.h"

#include <string.h>

#define RECORD_MAX 260 /* length, address (2), type, 255 data, checksum */

typedef struct { image_t *image; uint32_t base; bool ended; } reader_t;

static int digit(char c)
{
    return c >= '0' && c <= '9' ? c - '0' : c >= 'A' && c <= 'F' ? c - 'A' + 10 : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* Decodes the rest of a line after the colon. Returns the number of bytes, -1 if it is not hex. */
static int decode(const char *line, uint8_t record[RECORD_MAX])
{
    int count = 0;
    while (digit(line[0]) >= 0 && digit(line[1]) >= 0 && count < RECORD_MAX) {
        record[count++] = (uint8_t)(digit(line[0]) << 4 | digit(line[1]));
        line += 2;
    }
    return line[strspn(line, "\r\n \t")] == 0 ? count : -1;
}

static image_status_t take(reader_t *reader, const uint8_t *record, int count)
{
    uint8_t sum = 0;
    if (count < 5 || record[0] + 5 != count) {
        return IMAGE_SYNTAX;
    }
    for (int i = 0; i < count; i++) {
        sum = (uint8_t)(sum + record[i]);
    }
    if (sum) {
        return IMAGE_CHECKSUM;
    }
    uint32_t offset = (uint32_t)(record[1] << 8 | record[2]);
    uint32_t value = (uint32_t)(record[4] << 8 | record[5]); /* in address records */
    switch (record[3]) {
    case 0:
        return image_put(reader->image, reader->base + offset, record + 4, record[0]) ? IMAGE_OK : IMAGE_RANGE;
    case 1:
        reader->ended = true;
        return IMAGE_OK;
    case 2:
        reader->base = value << 4;
        return IMAGE_OK;
    case 4:
        reader->base = value << 16;
        return IMAGE_OK;
    case 3:
    case 5:
        return IMAGE_OK; /* start address: not needed */
    default:
        return IMAGE_SYNTAX;
    }
}

image_status_t intel_hex_read(FILE *file, image_t *image)
{
    reader_t reader = { image, 0, false };
    char line[2 * RECORD_MAX + 8];
    while (!reader.ended && fgets(line, sizeof line, file)) {
        uint8_t record[RECORD_MAX] = { 0 };
        if (line[strspn(line, "\r\n \t")] == 0) {
            continue;
        }
        int count = line[0] == ':' ? decode(line + 1, record) : -1;
        image_status_t status = count < 0 ? IMAGE_SYNTAX : take(&reader, record, count);
        if (status != IMAGE_OK) {
            return status;
        }
    }
    return reader.ended ? IMAGE_OK : IMAGE_NO_END;
}
