/* SPDX-License-Identifier: MIT
 * screen_send.c - sends characters and moves the terminal's cursor, the shortest way. */
#include "ansi.h"
#include "screen_parts.h"
#include "text.h"

void screen_send(char character)
{
    ansi_put(character);
    the_screen.at_column++;
    if (the_screen.at_column > SCREEN_COLUMNS) {
        the_screen.at_row = 0;
    }
}

void screen_send_text(const char *text)
{
    while (*text != '\0') {
        screen_send(*text++);
    }
}

void screen_send_text_P(const char *text)
{
    text_reader_t reader;
    text_open_P(&reader, text);
    for (char character; (character = text_next(&reader)) != '\0';) {
        screen_send(character);
    }
}

void screen_send_spaces(uint8_t count)
{
    while (count-- > 0) {
        screen_send(' ');
    }
}

void screen_go(uint8_t row, uint8_t column)
{
    if (the_screen.at_row == row && column > the_screen.at_column) {
        ansi_right((uint8_t)(column - the_screen.at_column));
    } else if (the_screen.at_row != row || the_screen.at_column != column) {
        ansi_goto(row, column);
    }
    the_screen.at_row = row;
    the_screen.at_column = column;
}

void screen_go_line(void)
{
    uint8_t column = the_screen.line_column;
    screen_go(screen_command_row(), column < SCREEN_COLUMNS ? column : (uint8_t)SCREEN_COLUMNS);
}
