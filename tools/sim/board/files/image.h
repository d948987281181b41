/* SPDX-License-Identifier: MIT
 * image.h - the contents of a flash image, filled by the file readers. */
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
    IMAGE_NO_END    /* HEX without an end record: truncated file */
} image_status_t;

/* Destination of the bytes: used[] marks those that the file contains. Both arrays have size elements. */
typedef struct {
    uint8_t *bytes;
    bool *used;
    size_t size;
} image_t;

const char *image_text(image_status_t status); /* to print after the file name */

/* Puts count bytes at address. false: out of range. */
bool image_put(image_t *image, uint32_t address, const uint8_t *data, size_t count);

#endif
