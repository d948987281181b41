/* SPDX-License-Identifier: MIT */

/* The page buffer is not filled either. */
#define START boot_page_fill(PAGE, 0x1234)
#include "spm_eeprom_boot.c"
