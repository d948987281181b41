/* SPDX-License-Identifier: MIT
 * image.h - the contents of a flash image, as the readers of its files fill it. */
#ifndef SIM_IMAGE_H
#define SIM_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum {
    IMAGE_OK,
    IMAGE_NO_FILE,
    IMAGE_SYNTAX,   /* HEX: not hex, wrong length, unknown record; ELF: not for the AVR */
    IMAGE_CHECKSUM, /* of a HEX record */
    IMAGE_RANGE,    /* outside 0..size-1 */
    IMAGE_NO_END    /* HEX without an end record: the file is cut off */
} image_status_t;

/* Where the bytes go: used[] tells which ones the file gives. Both have size places. */
typedef struct {
    uint8_t *bytes;
    bool *used;
    size_t size;
} image_t;

const char *image_text(image_status_t status); /* behind the name of the file */

/* Puts count bytes at address. false: outside. */
bool image_put(image_t *image, uint32_t address, const uint8_t *data, size_t count);

#endif
