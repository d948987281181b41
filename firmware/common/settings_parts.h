/* SPDX-License-Identifier: MIT
 * settings_parts.h - the ranges that settings.c and settings_names.c share. The texts are apart: only Play has them. */
#ifndef SETTINGS_PARTS_H
#define SETTINGS_PARTS_H

#include "settings.h"

extern const settings_range_t settings_ranges_P[SETTINGS_ITEMS];

#endif
