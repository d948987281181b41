/* SPDX-License-Identifier: MIT
 * performer_drive_none.c - for images that no program drives: the functions of performer_shape.h about driving, empty. */
#include "performer_shape.h"

bool performer_drive_is_lost(performer_t *performer)
{
    return false;
}

void performer_drive_end(performer_t *performer)
{
}

void performer_shape_follow(performer_t *performer)
{
}
