/* SPDX-License-Identifier: MIT */
#include "screen.h"

#include "ansi.h"
#include "frame.h"
#include "parts.h"
#include "screen_parts.h"

enum { SHOWN_UNSAVED = 1, SHOWN_HEX = 2, SHOWN_PAGE0 = 4 };
enum { FIXED_ROWS = 4, SCROLL_STEP = 4 };

/* ---- layout ---- */

static bool is_full(const screen_t *screen)
{
    return screen->rows >= SCREEN_ROWS_FULL;
}

static uint8_t table_rows(const screen_t *screen)
{
    return (uint8_t)(screen->rows - FIXED_ROWS);
}

uint8_t screen_command_row(const screen_t *screen)
{
    return screen->rows;
}

bool screen_has_row(const screen_t *screen, uint8_t joint)
{
    return is_full(screen) || screen->present == 0 || joint >= PAGE_JOINTS || (screen->present >> joint & 1u) != 0;
}

/* How many joints below `joint` have a row. */
static uint8_t rows_before(const screen_t *screen, uint8_t joint)
{
    uint8_t count = 0;
    for (uint8_t i = 0; i < joint; i++) {
        count = (uint8_t)(count + screen_has_row(screen, i));
    }
    return count;
}

uint8_t screen_row_of(const screen_t *screen, uint8_t y)
{
    if (y >= PAGE_JOINTS) {
        return (uint8_t)(table_rows(screen) + 1u + (y - PAGE_JOINTS));
    }
    if (!screen_has_row(screen, y)) {
        return 0;
    }
    uint8_t before = rows_before(screen, y);
    if (before < screen->top || before >= screen->top + table_rows(screen)) {
        return 0;
    }
    return (uint8_t)(before - screen->top + 1u);
}

/* The joint in screen row `row`, or the last one above it. */
static uint8_t joint_in_row(const screen_t *screen, uint8_t row)
{
    uint8_t joint = 0;
    for (uint8_t i = 0; i < PAGE_JOINTS; i++) {
        uint8_t at = screen_row_of(screen, i);
        if (at != 0 && at <= row) {
            joint = i;
        }
    }
    return joint;
}

/* ---- what follows from the session ---- */

static uint8_t flags_of(const session_t *session)
{
    return (uint8_t)((session->is_changed ? SHOWN_UNSAVED : 0) | (session->hex ? SHOWN_HEX : 0) |
                     (session->page == 0 ? SHOWN_PAGE0 : 0));
}

void screen_sync(screen_t *screen)
{
    session_t *session = &the_session;
    uint8_t flags = flags_of(session);
    uint8_t turned = flags ^ screen->shown_flags;
    uint8_t fault = frame_fault(session);
    screen_follow(screen);
    if (session->x != screen->shown_x || session->y != screen->shown_y || (turned & SHOWN_HEX) != 0) {
        screen->items |= ITEM_XYA;
    }
    if ((turned & SHOWN_HEX) != 0) {
        session_mark_all(session);
        screen->items |= ITEM_GO;
    }
    screen->items |= (turned & SHOWN_PAGE0) != 0 ? ITEM_LABELS | ITEM_GO : 0;
    screen->items |= (turned & SHOWN_UNSAVED) != 0 ? ITEM_UNSAVED : 0;
    screen->items |= session->go_step != screen->shown_go ? ITEM_GO : 0;
    screen->items |= fault != screen->shown_fault ? ITEM_FAULT : 0;
    screen->shown_x = session->x;
    screen->shown_y = session->y;
    screen->shown_go = session->go_step;
    screen->shown_flags = flags;
    screen->shown_fault = fault;
}

/* ---- whole screen ---- */

static void mark_frame(void)
{
    for (uint8_t y = 0; y < CELLS_ROWS; y++) {
        the_session.marks[y] = MARK_CELLS | MARK_HEADER_LABEL | (uint16_t)MARK_STEP_NONE << MARK_STEP_SHIFT;
    }
}

void screen_redraw(screen_t *screen)
{
    mark_frame();
    screen->items = ITEM_ALL;
    screen->at_row = 0;
}

void screen_init(screen_t *screen)
{
    screen->present = 0;
    screen->rows = SCREEN_ROWS_FULL;
    screen->top = 0;
    screen->sink = SCREEN_QUIET;
    screen->line_column = SCREEN_LINE_COLUMN;
    screen->lead = false;
    screen->hidden = false;
    screen->shown_x = 0;
    screen->shown_y = 0;
    screen->shown_go = SESSION_NO_STEP;
    screen->shown_fault = 0;
    screen->shown_flags = 0;
    screen_redraw(screen);
}

void screen_set_rows(screen_t *screen, uint8_t rows)
{
    uint8_t usable = rows < SCREEN_ROWS_MIN ? (uint8_t)SCREEN_ROWS_MIN : rows;
    if (usable > SCREEN_ROWS_FULL) {
        usable = SCREEN_ROWS_FULL;
    }
    if (usable != screen->rows) {
        screen->rows = usable;
        screen->top = 0;
        screen_redraw(screen);
        screen_follow(screen);
    }
}

void screen_set_present(screen_t *screen, uint32_t present)
{
    bool layout = present != screen->present && !is_full(screen);
    screen->present = present;
    if (layout) {
        screen->top = 0;
        screen_redraw(screen);
        screen_follow(screen);
    }
}

void screen_hide(screen_t *screen)
{
    ansi_clear();
    screen->hidden = true;
    screen->sink = SCREEN_PLAIN;
}

void screen_show(screen_t *screen)
{
    screen->hidden = false;
    screen->sink = SCREEN_QUIET;
    screen_redraw(screen);
}

/* ---- scrolling ---- */

void screen_follow(screen_t *screen)
{
    session_t *session = &the_session;
    if (is_full(screen) || session->x == CELL_X_HEADER || session->y >= PAGE_JOINTS) {
        return;
    }
    while (!screen_has_row(screen, session->y)) {
        session->y++;   /* ends at the pause, which always has one */
    }
    uint8_t before = rows_before(screen, session->y);
    uint8_t top = screen->top;
    if (before < top) {
        top = before > SCROLL_STEP ? (uint8_t)(before - SCROLL_STEP) : 0;
    } else if (before >= top + table_rows(screen)) {
        uint8_t last = (uint8_t)(rows_before(screen, PAGE_JOINTS) - 1u);
        uint8_t bottom = before + SCROLL_STEP > last ? last : (uint8_t)(before + SCROLL_STEP);
        top = (uint8_t)(bottom + 1u - table_rows(screen));
    }
    if (top != screen->top) {
        screen->top = top;
        mark_frame();
    }
}

static void move_to_header(screen_t *screen)
{
    session_t *session = &the_session;
    uint8_t row = screen_row_of(screen, session->y);
    if (row != 0 && cell_kind(session->page, CELL_X_HEADER, (uint8_t)(row - 1u)) != CELL_NONE) {
        session->x = CELL_X_HEADER;
        session->y = (uint8_t)(row - 1u);
    }
}

void screen_move(screen_t *screen, session_way_t way)
{
    session_t *session = &the_session;
    if (is_full(screen)) {
        session_move(session, way);
        return;
    }
    if (way == SESSION_RIGHT && session->x == CELL_X_SOFTNESS) {
        move_to_header(screen);
        return;
    }
    uint8_t x = session->x, y = session->y;
    session_move(session, way);
    if (x == CELL_X_HEADER && session->x != CELL_X_HEADER) {
        session->y = joint_in_row(screen, (uint8_t)(session->y + 1u));
    }
    while (!screen_has_row(screen, session->y)) {
        uint8_t before = session->y;
        session_move(session, way);
        if (session->y == before) {
            session->x = x;
            session->y = y;
        }
    }
}

/* ---- command row ---- */

void screen_open_line(screen_t *screen)
{
    screen->sink = SCREEN_LINE;
    screen->lead = false;
    screen_go(screen, screen_command_row(screen), SCREEN_LINE_COLUMN);
    ansi_erase_line();
    screen->line_column = SCREEN_LINE_COLUMN;
}

static void put_in_line(screen_t *screen, char character)
{
    if (character == '\r' || (uint8_t)character == '\a') {
        return;
    }
    if (character == '\n') {
        character = ' ';
    }
    if (character == '\b') {
        screen_go(screen, screen_command_row(screen), screen->line_column);
        ansi_put('\b');
        screen->line_column--;
        screen->at_column = screen->line_column;
    } else if (screen->line_column < SCREEN_COLUMNS) {
        screen_go(screen, screen_command_row(screen), screen->line_column);
        screen_send(screen, character);
        screen->line_column++;
    }
}

void screen_put(screen_t *screen, char character)
{
    if (screen->sink == SCREEN_PLAIN) {
        ansi_put(character);
    } else if (screen->sink == SCREEN_LINE) {
        if (screen->lead) {
            screen->lead = false;
            put_in_line(screen, ' ');
        }
        put_in_line(screen, character);
    }
}

void screen_ask_size(screen_t *screen)
{
    ansi_ask_size();
    screen->at_row = 0;
}
