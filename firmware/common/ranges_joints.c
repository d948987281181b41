/* SPDX-License-Identifier: MIT
 * ranges_joints.c - the joints that words name. A file of its own because it uses shell_words.c, which uses ranges.c. */
#include "ranges.h"

#include <stddef.h>
#include <string.h>
#include "servo_link.h"

bool ranges_take_joints(const shell_args_t *args, uint8_t first, uint32_t *joints)
{
    for (uint8_t i = first; i < args->count; i++) {
        char *dash = strchr(shell_word(args, i), '-');   /* the line is RAM of the caller: it may be cut here */
        uint16_t from, to;
        if (dash != NULL) {
            *dash = '\0';
        }
        if (!shell_take(args, i, RANGE_ID, &from)) {
            return false;
        }
        to = from;
        if (dash != NULL) {
            const shell_args_t last = {.words = dash + 1, .count = 1, .hex = args->hex};
            if (!shell_take(&last, 0, RANGE_ID, &to)) {
                return false;
            }
            *dash = '-';   /* shell_word finds the words after it by counting NULs */
        }
        servo_link_put(joints, (uint8_t)to, true);
        for (; from != to; from = from < to ? from + 1u : from - 1u) {
            servo_link_put(joints, (uint8_t)from, true);
        }
    }
    return true;
}
