/* SPDX-License-Identifier: MIT
 * ranges_joints.c - parses joint IDs. Separate from ranges.c, because it uses shell_words.c, which uses ranges.c. */
#include "ranges.h"

#include <stddef.h>
#include <string.h>
#include "servo_link.h"

bool ranges_take_joints(const shell_args_t *args, uint8_t first, uint32_t *joints)
{
    for (uint8_t i = first; i < args->count; i++) {
        const char *first_id = shell_word(args, i), *last_id = first_id;
        char *dash = strchr(first_id, '-');   /* the line is in the caller's RAM and may be cut here */
        uint16_t from, to;
        if (dash != NULL) {
            *dash = '\0';
            last_id = dash + 1;
        }
        if (!shell_take_word(first_id, args->hex, RANGE_ID, &from) || !shell_take_word(last_id, args->hex, RANGE_ID, &to)) {
            return false;
        }
        if (dash != NULL) {
            *dash = '-';   /* shell_word finds the words after it by counting NULs */
        }
        const uint8_t low = (uint8_t)(from < to ? from : to), high = (uint8_t)(from < to ? to : from);
        for (uint8_t id = low; id <= high; id++) {
            servo_link_put(joints, id, true);
        }
    }
    return true;
}
