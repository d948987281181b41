/* SPDX-License-Identifier: MIT
 * elf_image.h - reads the loadable segments of an AVR ELF file into an image, at their load (flash) addresses. Leaves
 * out RAM-only, EEPROM, fuse and lock segments. */
#ifndef SIM_ELF_IMAGE_H
#define SIM_ELF_IMAGE_H

#include <stdio.h>

#include "image.h"

image_status_t elf_image_read(FILE *file, image_t *image);

#endif
