/* SPDX-License-Identifier: MIT */

/* Only the high byte has ones that need the erase. */
#define SECOND 0x4234
#include "flash_unerased_boot.c"
