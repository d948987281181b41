/* SPDX-License-Identifier: MIT
 * intel_hex.h - reads Intel HEX into an image, and checks checksums, ranges and record types. */
#ifndef SIM_INTEL_HEX_H
#define SIM_INTEL_HEX_H

#include <stdio.h>

#include "image.h"

image_status_t intel_hex_read(FILE *file, image_t *image);

#endif
