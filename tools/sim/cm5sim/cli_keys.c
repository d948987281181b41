/* SPDX-License-Identifier: MIT */
#include "cli_keys.h"

#include <ctype.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#define ESC 0x1B

static struct termios before;
static bool raw;

/* The remote's word: bits of U D L R 1..6. */
enum { RC_U = 1, RC_D = 2, RC_L = 4, RC_R = 8, RC_1 = 16 };

const char *keys_help(void)
{
    return "Ctrl-]           leave\n"
           "Ctrl-T h         a hand at the robot: `push 3 600`, `let go`, `battery 7.0`, ...\n"
           "Ctrl-T v         servos: goal, present position, torque, alarms\n"
           "Ctrl-T r         keyboard <-> RC-100 (arrows or w s a d; 1..6; space = 6, stop)\n"
           "Ctrl-T arrow, s  panel buttons Up, Down, Left, Right, START\n"
           "Ctrl-T m         MODE button (reset)\n"
           "Ctrl-T p         power off / on\n"
           "Ctrl-T Ctrl-T    sends Ctrl-T\n";
}

/* Index 0..3 of Up Down Left Right, -1: something else, -2: a sequence has begun. */
static int arrow(keys_t *keys, uint8_t byte)
{
    if (keys->escape == 0 && byte == ESC) {
        keys->escape = 1;
        return -2;
    }
    if (keys->escape == 1 && (byte == '[' || byte == 'O')) {
        keys->escape = 2;
        return -2;
    }
    const bool complete = keys->escape == 2;
    keys->escape = 0;
    switch (complete ? byte : 0) {
    case 'A': return 0;
    case 'B': return 1;
    case 'C': return 3;
    case 'D': return 2;
    default: return -1;
    }
}

static key_press_t take_prefixed(keys_t *keys, uint8_t byte)
{
    static const button_t buttons[4] = {BUTTON_UP, BUTTON_DOWN, BUTTON_LEFT, BUTTON_RIGHT};
    const int direction = arrow(keys, byte);
    keys->prefixed = direction == -2;
    if (direction == -2) {
        return (key_press_t){KEY_NONE, 0};
    }
    if (direction >= 0) {
        return (key_press_t){KEY_BUTTON, (uint16_t)buttons[direction]};
    }
    switch (tolower(byte)) {
    case KEY_PREFIX: return (key_press_t){KEY_BYTE, KEY_PREFIX};
    case 'r': keys->rc_mode = !keys->rc_mode; return (key_press_t){KEY_RC_MODE, keys->rc_mode};
    case 's': return (key_press_t){KEY_BUTTON, BUTTON_START};
    case 'm': return (key_press_t){KEY_BUTTON, BUTTON_MODE};
    case 'p': return (key_press_t){KEY_POWER, 0};
    case 'v': return (key_press_t){KEY_SERVOS, 0};
    case 'h': return (key_press_t){KEY_LINE, 0};
    default: return (key_press_t){KEY_HELP, 0};
    }
}

static key_press_t take_rc(keys_t *keys, uint8_t byte)
{
    static const uint16_t directions[4] = {RC_U, RC_D, RC_L, RC_R};
    const int direction = arrow(keys, byte);
    if (direction >= 0) {
        return (key_press_t){KEY_RC, directions[direction]};
    }
    if (byte >= '1' && byte <= '6' && direction == -1) {
        return (key_press_t){KEY_RC, (uint16_t)(RC_1 << (byte - '1'))};
    }
    switch (direction == -1 ? tolower(byte) : 0) {
    case 'w': return (key_press_t){KEY_RC, RC_U};
    case 's': return (key_press_t){KEY_RC, RC_D};
    case 'a': return (key_press_t){KEY_RC, RC_L};
    case 'd': return (key_press_t){KEY_RC, RC_R};
    case ' ': return (key_press_t){KEY_RC, RC_1 << 5};
    default: return (key_press_t){KEY_NONE, 0};
    }
}

key_press_t keys_take(keys_t *keys, uint8_t byte)
{
    if (keys->prefixed) {
        return take_prefixed(keys, byte);
    }
    if (byte == KEY_LEAVE) {
        return (key_press_t){KEY_EXIT, 0};
    }
    if (byte == KEY_PREFIX) {
        keys->prefixed = true;
        keys->escape = 0;
        return (key_press_t){KEY_NONE, 0};
    }
    return keys->rc_mode ? take_rc(keys, byte) : (key_press_t){KEY_BYTE, byte};
}

bool keys_raw(void)
{
    static bool arranged;
    if (tcgetattr(STDIN_FILENO, &before) != 0) {
        return false;
    }
    struct termios settings = before;
    cfmakeraw(&settings);
    raw = tcsetattr(STDIN_FILENO, TCSANOW, &settings) == 0;
    if (raw && !arranged) {
        arranged = atexit(keys_restore) == 0;
    }
    return raw;
}

void keys_restore(void)
{
    if (raw) {
        (void)tcsetattr(STDIN_FILENO, TCSADRAIN, &before);
        raw = false;
    }
}

bool keys_are_raw(void)
{
    return raw;
}
