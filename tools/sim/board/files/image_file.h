/* SPDX-License-Identifier: MIT
 * image_file.h - reads a flash image from an Intel HEX, ELF or binary file, strictly. */
#ifndef SIM_IMAGE_FILE_H
#define SIM_IMAGE_FILE_H

#include "image.h"

/* Reads path; the suffix, in any case, selects *.hex or *.ihex, *.elf, or binary at address. Clears used[] first. */
image_status_t image_file_read(const char *path, uint32_t address, image_t *image);

#endif
