/* SPDX-License-Identifier: MIT */
#include "keys.h"

enum { GROUND = 0, ESCAPE, SEQUENCE };
enum { ESC = 0x1B };

void keys_init(keys_t *keys)
{
    keys->state = GROUND;
    keys->number = 0;
    keys->first = 0;
    keys->rows = 0;
}

bool keys_is_open(const keys_t *keys)
{
    return keys->state != GROUND;
}

static uint8_t final_byte(keys_t *keys, uint8_t byte)
{
    keys->state = GROUND;
    switch (byte) {
    case 'A': return KEY_UP;
    case 'B': return KEY_DOWN;
    case 'C': return KEY_RIGHT;
    case 'D': return KEY_LEFT;
    case 'H': return KEY_HOME;
    case 'F': return KEY_END;
    case '~':   /* ESC [ number ~ */
        switch (keys->number) {
        case 1:
        case 7: return KEY_HOME;
        case 4:
        case 8: return KEY_END;
        case 5: return KEY_PAGE_UP;
        case 6: return KEY_PAGE_DOWN;
        default: return KEY_NONE;
        }
    case 'R':
        keys->rows = keys->first;
        return KEY_SIZE;
    default: return KEY_NONE;
    }
}

static uint8_t sequence_byte(keys_t *keys, uint8_t byte)
{
    if (byte >= '0' && byte <= '9') {
        uint16_t number = (uint16_t)(keys->number * 10u + (uint8_t)(byte - '0'));
        keys->number = number > UINT8_MAX ? UINT8_MAX : (uint8_t)number;
        return KEY_NONE;
    }
    if (byte == ';') {
        keys->first = keys->number;
        keys->number = 0;
        return KEY_NONE;
    }
    if (byte >= 0x40 && byte <= 0x7E) {
        return final_byte(keys, byte);
    }
    if (byte < ' ') {
        keys->state = GROUND;
    }
    return KEY_NONE;
}

uint8_t keys_byte(keys_t *keys, uint8_t byte)
{
    if (byte == ESC) {
        keys->state = ESCAPE;
        return KEY_NONE;
    }
    if (keys->state == ESCAPE) {
        keys->state = byte == '[' || byte == 'O' ? SEQUENCE : GROUND;
        keys->number = 0;
        keys->first = 0;
        return KEY_NONE;
    }
    if (keys->state == SEQUENCE) {
        return sequence_byte(keys, byte);
    }
    if (byte == 0 || byte >= KEY_NONE) {
        return KEY_NONE;
    }
    return byte;
}

uint8_t keys_quiet(keys_t *keys)
{
    bool lone = keys->state == ESCAPE;
    keys->state = GROUND;
    return lone ? KEY_ESCAPE : KEY_NONE;
}
