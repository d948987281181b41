/* SPDX-License-Identifier: MIT
 * screen.c - a terminal for Edit, and the table read from it. The columns are those of firmware/edit/ORIGINAL.md 3.
 * Rows are found by their labels, because a low terminal has fewer. */
#include "session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ROWS 36u
#define ARGUMENTS 4u
#define SAID_BYTES 4096u          /* a tick draws two screens at most */

static struct {
    char text[ROWS][SCREEN_COLUMNS + 1];
    unsigned row, column;
    int argument[ARGUMENTS];
    unsigned arguments;
    char said[SAID_BYTES];         /* what this tick has printed, on whatever row, also if it is erased again */
    unsigned said_bytes;
    bool is_table;                 /* the table was not hidden since the screen was cleared */
    enum { PLAIN, ESCAPE, SEQUENCE } state;
} screen;

/* ---- the terminal ---- */

static void clear_from(unsigned row, unsigned column)
{
    memset(screen.text[row] + column, ' ', SCREEN_COLUMNS - column);
}

static void clear_all(void)
{
    for (unsigned row = 0; row < ROWS; row++) {
        clear_from(row, 0);
    }
    screen.is_table = true;
}

static unsigned argument(unsigned at, unsigned otherwise)
{
    return at < screen.arguments && screen.argument[at] > 0 ? (unsigned)screen.argument[at] : otherwise;
}

static unsigned within(unsigned value, unsigned end)
{
    return value < end ? value : end - 1;
}

static void obey(uint8_t final)
{
    if (final == 'H' || final == 'f') {
        screen.row = within(argument(0, 1) - 1, ROWS);
        screen.column = within(argument(1, 1) - 1, SCREEN_COLUMNS);
    } else if (final == 'C') {
        screen.column = within(screen.column + argument(0, 1), SCREEN_COLUMNS);
    } else if (final == 'D') {
        screen.column -= argument(0, 1) < screen.column ? argument(0, 1) : screen.column;
    } else if (final == 'K') {
        clear_from(screen.row, screen.column);
    } else if (final == 'J') {
        clear_all();
    }
}

static void show_plain(uint8_t byte)
{
    if (byte == 0x1B) {
        screen.state = ESCAPE;
    } else if (byte == '\r') {
        screen.column = 0;
    } else if (byte == '\b') {
        screen.column -= screen.column > 0 ? 1 : 0;
    } else if (byte == '\n' && screen.row + 1 < ROWS) {
        screen.row++;
    } else if (byte == '\n') {
        memmove(screen.text[0], screen.text[1], sizeof screen.text - sizeof screen.text[0]);
        clear_from(ROWS - 1, 0);
    } else if (byte >= ' ') {
        screen.said[screen.said_bytes] = (char)byte;
        screen.said_bytes = within(screen.said_bytes + 1, SAID_BYTES - 1);
        screen.text[screen.row][screen.column] = (char)byte;
        screen.column = within(screen.column + 1, SCREEN_COLUMNS);
    }
}

void screen_byte(uint8_t byte)
{
    if (screen.state == PLAIN) {
        show_plain(byte);
    } else if (screen.state == ESCAPE) {
        screen.state = byte == '[' ? SEQUENCE : PLAIN;
        screen.arguments = 1;
        screen.argument[0] = 0;
    } else if (byte == ';' && screen.arguments < ARGUMENTS) {
        screen.argument[screen.arguments++] = 0;
    } else if (byte >= '0' && byte <= '9') {
        screen.argument[screen.arguments - 1] = screen.argument[screen.arguments - 1] * 10 + byte - '0';
    } else {
        obey(byte);
        screen.state = PLAIN;
    }
}

/* ---- the table ---- */

/* Returns a number of `digits` digits, or UNKNOWN. */
static int number_at(const char *text, unsigned digits, bool is_hex)
{
    char copy[9] = "", *end;
    memcpy(copy, text, digits);
    if (is_hex && copy[digits - 1] == ' ') {
        copy[digits - 1] = '\0';   /* a byte has two hexadecimal digits and a space */
    }
    const long number = strtol(copy, &end, is_hex ? 16 : 10);
    return end != copy && *end == '\0' && copy[0] != ' ' ? (int)number : UNKNOWN;
}

/* Of larger numbers in decimal only the last four digits are shown (edit/ORIGINAL.md section 1). */
static int word_at(const char *text, bool is_hex)
{
    const int number = number_at(text, 4, is_hex);
    const bool may_be_cut = !is_hex && number != limited(number) && number != UNKNOWN;
    return strncmp(text, "----", 4) == 0 ? NO_VALUE : strncmp(text, "????", 4) == 0 ? OFF : may_be_cut ? UNKNOWN : number;
}

static void read_row(table_t *table, const char *text, bool is_hex)
{
    static const struct {
        const char *label;
        unsigned field;
    } fields[] = {{"PlayCount:", 1},      {"Blend Right:", 3},   {"Blend Left:", 4},    {"Page Step:", FIELD_STEPS},
                  {"ControlCode:", 7},    {"Page Speed:", 8},    {"DXL Setup:", 9},     {"Accel Time:", 10},
                  {"Link to Next:", 11},  {"Link to Exit:", 12}, {"Linked Page1:", 13}, {"Page1Remocon:", 14},
                  {"Linked Page2:", 15},  {"Page2Remocon:", 16}};
    unsigned id;
    const bool is_joint = sscanf(text, "Dynamixel %u(", &id) == 1 && id < JOINTS;
    const bool is_time = strncmp(text, "   Time(", 8) == 0, is_pause = strncmp(text, "   PauseTime", 12) == 0;
    for (unsigned i = 0; i < sizeof fields / sizeof fields[0] && is_joint; i++) {
        if (strstr(text + 60, fields[i].label) != NULL) {
            table->field[fields[i].field] = number_at(text + 76, 3, is_hex);
        }
    }
    for (unsigned step = 0; step < TABLE_STEPS; step++) {
        const char *shown = text + (step == 0 ? 19u : 20u + 5u * step);
        if (is_joint) {
            table->cell[step][id] = word_at(shown, is_hex);
        } else if (is_pause || is_time || strncmp(text, "   Speed", 8) == 0) {
            table->cell[step][is_pause ? ROW_PAUSE : ROW_TIME] = number_at(shown + 1, 3, is_hex);
        }
    }
    if (is_joint) {
        table->softness[id] = number_at(text + 60, 3, is_hex);
        table->live[id] = strncmp(text + 13, "0x", 2) == 0 ? UNKNOWN : number_at(text + 13, 4, is_hex);
    } else if (is_time || strncmp(text, "   Speed", 8) == 0) {
        table->is_time = is_time;
    }
}

/* X, Y and A must match; all three are decimal or hexadecimal. */
static bool read_cursor(table_t *table, const char *text, bool *is_hex)
{
    unsigned x, y, a;
    *is_hex = sscanf(text, "[X:%2u,Y:%2u,A:%4u]", &x, &y, &a) != 3 || table_offset(x, y) != a;
    if (*is_hex && (sscanf(text, "[X:%2x,Y:%2x,A:%4x]", &x, &y, &a) != 3 || table_offset(x, y) != a)) {
        return false;
    }
    table->x = x;
    table->y = y;
    return true;
}

bool screen_read(table_t *table)
{
    bool is_hex = false, has_cursor = false, has_page = false;
    const char *command = "";
    memset(table, 0, sizeof *table);
    table_forget(table);
    table->is_saved = true;
    for (unsigned row = 0; row < ROWS; row++) {
        const char *text = screen.text[row], *cursor = strstr(text, "[X:");
        if (cursor != NULL) {
            has_cursor = true;
            if (!read_cursor(table, cursor, &is_hex)) {
                session_fail("X, Y and A of Edit belong together", "%.20s", cursor);
            }
        }
    }
    for (unsigned row = 0; row < ROWS && has_cursor; row++) {
        const char *text = screen.text[row], *number = strstr(text, "PageNumber:"), *address = strstr(text, "Addr:");
        const char *label = strstr(text, "Go Step:");
        has_page = has_page || number != NULL;
        table->page = number != NULL ? number_at(number + 11, 4, is_hex) : table->page;
        table->address = address != NULL ? number_at(address + 5, 8, true) : table->address;
        table->is_saved = table->is_saved && text[0] != '*';
        table->has_go_step = table->has_go_step || label != NULL;
        table->go_step = label != NULL ? number_at(label + 8, 3, is_hex) : table->go_step;
        command = label != NULL && row + 1 < ROWS ? screen.text[row + 1] : command;
        read_row(table, text, is_hex);
        if (row == 0) {
            memcpy(table->name, text + 64, NAME_BYTES);
        }
    }
    memcpy(table->command, command, strlen(command) + 1);
    table->is_hex = is_hex;
    return screen.is_table && has_cursor && has_page && table->has_go_step;
}

void screen_put_away(void)
{
    screen.is_table = false;
}

const char *screen_row(unsigned row)
{
    return row < ROWS ? screen.text[row] : "";
}

bool screen_has_said(const char *text)
{
    return strstr(screen.said, text) != NULL;
}

void screen_tick(void)
{
    memset(screen.said, 0, sizeof screen.said);
    screen.said_bytes = 0;
}

void screen_boot(void)
{
    clear_all();
    screen.is_table = false;
    screen.row = screen.column = 0;
    screen.state = PLAIN;
}
