/* SPDX-License-Identifier: MIT */
#include "ansi.h"

#include "compiler.h"
#include "console.h"
#include "parts.h"
#include "pgm.h"
#include "tick.h"

static void put_P(const char *text)
{
    for (char character; (character = (char)pgm_read_byte(text)) != '\0'; text++) {
        ansi_put(character);
    }
}

static void put_number(uint8_t number)
{
    if (number >= 100) {
        ansi_put((char)('0' + number / 100));
    }
    if (number >= 10) {
        ansi_put((char)('0' + number / 10 % 10));
    }
    ansi_put((char)('0' + number % 10));
}

/* Waits for room: at most 0.5 ms, the time of three bytes. Serves only the tick, because the rest of robot_serve needs more
 * stack than is left here. */
static void wait_for_room(void)
{
    for (uint8_t turn = 0; turn < UINT8_MAX && console_room() == 0; turn++) {
        if (!performer_is_idle(&the_performer) && tick_take()) {
            performer_tick(&the_performer);
        }
    }
}

void ansi_put(char character)
{
    wait_for_room();
    console_write(&character, 1);
}

void ansi_goto(uint8_t row, uint8_t column)
{
    put_P(PSTR("\033["));
    put_number(row);
    ansi_put(';');
    put_number(column);
    ansi_put('H');
}

void ansi_right(uint8_t columns)
{
    put_P(PSTR("\033["));
    if (columns > 1) {
        put_number(columns);
    }
    ansi_put('C');
}

void ansi_clear(void)
{
    put_P(PSTR("\033[H\033[2J"));
}

void ansi_erase_line(void)
{
    put_P(PSTR("\033[K"));
}

void ansi_ask_size(void)
{
    put_P(PSTR("\033[999;999H\033[6n"));
}
