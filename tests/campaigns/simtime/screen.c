/* SPDX-License-Identifier: MIT
 * screen.c - a terminal for Edit, and what its table must show: while the mark `* unsaved` is not there, the page in flash.
 * The places are those of firmware/edit/ORIGINAL.md 3; rows are found by their labels, because a low terminal has fewer. */
#include "session.h"

#include <stdio.h>
#include <string.h>

#define ROWS 36u
#define COLUMNS 96u
#define STEPS 7u
#define QUIET 96u                  /* ticks without a key and without a byte: all is painted */
#define ARGUMENTS 4u

static struct {
    char text[ROWS][COLUMNS + 1];
    unsigned row, column;
    int argument[ARGUMENTS];
    unsigned arguments;
    enum { PLAIN, ESCAPE, SEQUENCE } state;
    bool is_table;                 /* nothing but the table has been painted since it was cleared */
    bool was_seen;                 /* as it is now */
} screen;

/* ---- the terminal ---- */

static void clear_from(unsigned row, unsigned column)
{
    memset(screen.text[row] + column, ' ', COLUMNS - column);
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
        screen.column = within(argument(1, 1) - 1, COLUMNS);
    } else if (final == 'C') {
        screen.column = within(screen.column + argument(0, 1), COLUMNS);
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
        screen.text[screen.row][screen.column] = (char)byte;
        screen.column = within(screen.column + 1, COLUMNS);
    }
}

void screen_byte(uint8_t byte)
{
    screen.was_seen = false;
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

static void wrong(unsigned page, const char *what, const char *shown, unsigned must)
{
    session_fail("without `* unsaved` the table shows what flash holds", "page %u, %s: \"%.5s\" is shown, %u is stored",
                 page, what, shown, must);
}

/* Three characters of a byte, decimal, or two hexadecimal digits and a blank. */
static void byte_must_be(unsigned page, const char *what, const char *shown, unsigned must)
{
    char decimal[8], hex[8];
    snprintf(decimal, sizeof decimal, "%03u", must & 0xFFu);
    snprintf(hex, sizeof hex, "%02X ", must & 0xFFu);
    if (strncmp(shown, decimal, 3) != 0 && strncmp(shown, hex, 3) != 0) {
        wrong(page, what, shown, must);
    }
}

static void word_must_be(unsigned page, const char *what, const char *shown, unsigned must)
{
    char decimal[8], hex[8];
    snprintf(decimal, sizeof decimal, "%04u", must & 0xFFFFu);
    snprintf(hex, sizeof hex, "%04X", must & 0xFFFFu);
    if (must > 1023 ? strncmp(shown, must & 0x2000u ? "????" : "----", 4) != 0
                    : strncmp(shown, decimal, 4) != 0 && strncmp(shown, hex, 4) != 0) {
        wrong(page, what, shown, must);
    }
}

static void look_at_row(unsigned page, const uint8_t *at, const char *text)
{
    static const struct {
        const char *label;
        unsigned byte;
    } fields[] = {{"PlayCount:", 15}, {"Blend Right:", 17}, {"Blend Left:", 18}, {"Page Step:", 20}, {"ControlCode:", 21},
                  {"Page Speed:", 22}, {"DXL Setup:", 23}, {"Accel Time:", 24}, {"Link to Next:", 25}, {"Link to Exit:", 26},
                  {"Linked Page1:", 27}, {"Page1Remocon:", 28}, {"Linked Page2:", 29}, {"Page2Remocon:", 30}};
    unsigned id;
    const bool is_joint = sscanf(text, "Dynamixel %u(", &id) == 1 && id < JOINTS;
    for (unsigned i = 0; i < sizeof fields / sizeof fields[0] && is_joint; i++) {
        if (strstr(text + 60, fields[i].label) != NULL) {
            byte_must_be(page, fields[i].label, text + 76, at[fields[i].byte]);
        }
    }
    for (unsigned step = 0; step < STEPS; step++) {
        const uint8_t *of = at + STEP_BYTES * (step + 1);
        const char *shown = text + 25 + 5 * step;
        char what[40];
        snprintf(what, sizeof what, "step %u, %.20s", step, text);
        if (is_joint) {
            word_must_be(page, what, shown, of[2 * id] | (unsigned)of[2 * id + 1] << 8);
        } else if (strncmp(text, "   PauseTime", 12) == 0) {
            byte_must_be(page, what, shown + 1, of[62]);
        } else if (strncmp(text, "   Time(", 8) == 0 || strncmp(text, "   Speed", 8) == 0) {
            byte_must_be(page, what, shown + 1, of[63]);
        }
    }
    if (is_joint) {
        byte_must_be(page, "softness", text + 60, at[32 + id]);
    }
}

/* The byte's offset in page and work pose. */
static unsigned offset_of(unsigned x, unsigned y)
{
    const unsigned in_step = y < 31 ? 2 * y : y == 31 ? 62 : 63;
    return x == 0 ? PAGE_BYTES + in_step : x <= STEPS ? STEP_BYTES * x + in_step : x == 8 ? 32 + y : 11 + y;
}

/* X, Y and A belong together; all three are decimal or hexadecimal. */
static void look_at_cursor(const char *text)
{
    unsigned x, y, a, hex_x, hex_y, hex_a;
    if (sscanf(text, "[X:%2u,Y:%2u,A:%4u]", &x, &y, &a) == 3 && offset_of(x, y) == a) {
        reached("cursor and its offset in Edit");
    } else if (sscanf(text, "[X:%2x,Y:%2x,A:%4x]", &hex_x, &hex_y, &hex_a) == 3 && offset_of(hex_x, hex_y) != hex_a) {
        session_fail("X, Y and A of Edit belong together", "%.20s", text);
    }
}

static bool is_whole(const uint8_t *at)
{
    uint8_t sum = 0;
    for (unsigned i = 0; i < PAGE_BYTES; i++) {
        sum = (uint8_t)(sum + at[i]);
    }
    return sum == 0xFF && at[20] <= STEPS && at[22] != 0;
}

static void look(void)
{
    unsigned page = 0, decimal = 0, hex = 0;
    bool is_table = false, is_saved = true;
    for (unsigned row = 0; row < ROWS; row++) {
        const char *number = strstr(screen.text[row], "PageNumber:"), *address = strstr(screen.text[row], "Addr:");
        is_table = is_table || (number != NULL && sscanf(number, "PageNumber:%4u", &decimal) == 1 &&
                                sscanf(number, "PageNumber:%4x", &hex) == 1);
        page = address != NULL && sscanf(address, "Addr:%8x", &page) == 1 ? page / PAGE_BYTES % 256 : page;
        is_saved = is_saved && screen.text[row][0] != '*';
        if (strstr(screen.text[row], "[X:") != NULL) {
            look_at_cursor(strstr(screen.text[row], "[X:"));
        }
    }
    if (is_table && page != decimal && page != hex) {
        wrong(page, "PageNumber", "", page);
    }
    const uint8_t *at = page_at(page);
    if (!is_table || !is_saved || page == 0 || !is_whole(at)) {
        return;
    }
    reached("table of Edit as flash holds it");
    for (unsigned row = 0; row < ROWS; row++) {
        look_at_row(page, at, screen.text[row]);
    }
}

/* ---- time ---- */

void screen_typed(const char *line)
{
    screen.is_table = screen.is_table && line[0] != '@';   /* such a line puts the table away */
}

void screen_tick(void)
{
    const uint32_t last = session.typed_tick > session.printed_tick ? session.typed_tick : session.printed_tick;
    if (session.is_edit && screen.is_table && !screen.was_seen && session.tick - last > QUIET && simtime_has_typed()) {
        screen.was_seen = true;
        look();
    }
}

void screen_boot(void)
{
    clear_all();
    screen.is_table = false;
    screen.row = screen.column = 0;
    screen.state = PLAIN;
}
