/* SPDX-License-Identifier: MIT */
#include "echo.h"

#include <string.h>

void echo_clear(echo_t *echo)
{
    memset(echo, 0, sizeof *echo);
}

static void forget(echo_t *echo, uint8_t count)
{
    echo->count = (uint8_t)(echo->count - count);
    memmove(echo->sent, echo->sent + count, echo->count * sizeof echo->sent[0]);
}

void echo_sent(echo_t *echo, const uint8_t *packet, uint8_t size)
{
    if (echo->count == ECHO_PACKETS) {
        forget(echo, 1);   /* it was never echoed */
    }
    echo->sent[echo->count].size = size;
    memcpy(echo->sent[echo->count].bytes, packet, size);
    echo->count++;
}

/* The held bytes compared with the packets sent: one of them, the beginning of one, or neither. */
typedef enum { ECHO_WHOLE, ECHO_BEGUN, ECHO_OTHER } match_t;

static match_t match(const echo_t *echo, uint8_t *which)
{
    match_t found = ECHO_OTHER;
    for (uint8_t i = 0; i < echo->count; i++) {
        const uint16_t size = echo->sent[i].size;
        const uint16_t common = echo->held_count < size ? echo->held_count : size;
        if (memcmp(echo->held, echo->sent[i].bytes, common) != 0) {
            continue;
        }
        if (common == size) {
            *which = i;
            return ECHO_WHOLE;
        }
        found = ECHO_BEGUN;
    }
    return found;
}

static void drop_held(echo_t *echo, uint16_t count)
{
    echo->held_count = (uint16_t)(echo->held_count - count);
    memmove(echo->held, echo->held + count, echo->held_count);
}

uint16_t echo_byte(echo_t *echo, uint8_t byte, uint8_t *out)
{
    uint16_t passed = 0;
    uint8_t which = 0;
    echo->held[echo->held_count++] = byte;
    while (echo->held_count > 0) {
        const match_t found = match(echo, &which);
        if (found == ECHO_BEGUN) {
            break;
        }
        if (found == ECHO_WHOLE) {
            drop_held(echo, echo->sent[which].size);
            forget(echo, (uint8_t)(which + 1u));   /* earlier ones were damaged on the way */
            echo->dropped++;
        } else {
            out[passed++] = echo->held[0];
            drop_held(echo, 1);
        }
    }
    return passed;
}

uint16_t echo_quiet(echo_t *echo, uint8_t *out)
{
    const uint16_t passed = echo->held_count;
    memcpy(out, echo->held, passed);
    echo->held_count = 0;
    return passed;
}
