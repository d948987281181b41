/* SPDX-License-Identifier: MIT */
#include "screen.h"

#include "ansi.h"
#include "frame.h"
#include "page_store.h"
#include "pgm.h"

/* Single items, in the order in which they are sent. */
enum {
    ITEM_CLEAR = 1 << 0,
    ITEM_LABELS = 1 << 1,
    ITEM_XYA_FRAME = 1 << 2,
    ITEM_XYA = 1 << 3,
    ITEM_GO = 1 << 4,
    ITEM_UNSAVED = 1 << 5,
    ITEM_FAULT = 1 << 6,
    ITEM_PROMPT = 1 << 7,
    ITEM_ALL = (1 << 8) - 1
};
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

static uint8_t command_row(const screen_t *screen)
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

/* Screen row of table row y; 0: it is not in sight. */
static uint8_t row_of(const screen_t *screen, uint8_t y)
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
        uint8_t at = row_of(screen, i);
        if (at != 0 && at <= row) {
            joint = i;
        }
    }
    return joint;
}

/* ---- sending ---- */

static void send(screen_t *screen, char character)
{
    ansi_put(character);
    screen->at_column++;
    if (screen->at_column > SCREEN_COLUMNS) {
        screen->at_row = 0;
    }
}

static void send_text(screen_t *screen, const char *text)
{
    while (*text != '\0') {
        send(screen, *text++);
    }
}

static void send_text_P(screen_t *screen, const char *text)
{
    for (char character; (character = (char)pgm_read_byte(text)) != '\0'; text++) {
        send(screen, character);
    }
}

static void send_spaces(screen_t *screen, uint8_t count)
{
    while (count-- > 0) {
        send(screen, ' ');
    }
}

static void go(screen_t *screen, uint8_t row, uint8_t column)
{
    if (screen->at_row == row && column > screen->at_column) {
        ansi_right((uint8_t)(column - screen->at_column));
    } else if (screen->at_row != row || screen->at_column != column) {
        ansi_goto(row, column);
    }
    screen->at_row = row;
    screen->at_column = column;
}

static char marker_at(const screen_t *screen, uint8_t column)
{
    uint8_t steps = screen->session->cells[PAGE_AT_STEPS];
    return steps <= PAGE_STEPS && column == frame_marker_column(steps) ? '|' : ' ';
}

/* Goes right within table row y. Short gaps are written anew, which is shorter than a cursor sequence: what stands there
 * is the bracket of the work pose, a marker or nothing. */
static void go_in_row(screen_t *screen, uint8_t row, uint8_t y, uint8_t column)
{
    if (screen->at_row == row && y < PAGE_JOINTS && column > screen->at_column && column - screen->at_column <= 2) {
        if (screen->at_column == FRAME_BRACKET_COLUMN) {
            send(screen, ']');
        }
        while (screen->at_column < column && frame_is_marker_column(screen->at_column)) {
            send(screen, marker_at(screen, screen->at_column));
        }
    }
    go(screen, row, column);
}

/* ---- a table row ---- */

static void paint_cell(screen_t *screen, uint8_t row, uint8_t x, uint8_t y)
{
    char text[CELLS_TEXT_BYTES];
    frame_cell_text(screen->session, x, y, text);
    go_in_row(screen, row, y, frame_cell_column(x, y));
    send_text(screen, text);
}

static void paint_marker(screen_t *screen, uint8_t row, uint8_t y, uint8_t steps)
{
    uint8_t shown = (uint8_t)(screen->session->marks[y] >> MARK_STEP_SHIFT);
    uint8_t wanted = screen->session->cells[PAGE_AT_STEPS];
    if (wanted > PAGE_STEPS) {
        wanted = MARK_STEP_NONE;
    }
    if (y < PAGE_JOINTS && shown != wanted && (steps == shown || steps == wanted)) {
        go_in_row(screen, row, y, frame_marker_column(steps));
        send(screen, steps == wanted ? '|' : ' ');
    }
}

static void set_marker_shown(screen_t *screen, uint8_t y)
{
    uint8_t steps = screen->session->cells[PAGE_AT_STEPS];
    uint16_t shown = steps > PAGE_STEPS ? (uint16_t)MARK_STEP_NONE : steps;
    uint16_t *marks = &screen->session->marks[y];
    *marks = (uint16_t)((*marks & ~(0xFu << MARK_STEP_SHIFT)) | shown << MARK_STEP_SHIFT);
}

static void paint_label(screen_t *screen, uint8_t row, uint8_t y, uint16_t marks)
{
    char text[FRAME_LABEL_BYTES];
    if ((marks & MARK_HEADER_LABEL) != 0) {
        go(screen, row, 1);
        frame_label_text(screen->session, y, text);
        send_text(screen, text);
    } else if ((marks & MARK_LABEL) != 0) {
        uint8_t skip = y < PAGE_JOINTS ? FRAME_LIVE_COLUMN - 1 : 0;
        frame_label_text(screen->session, y, text);
        text[y < PAGE_JOINTS ? FRAME_LIVE_COLUMN + FRAME_LIVE_CHARS - 1 : FRAME_BRACKET_COLUMN - 5] = '\0';
        go(screen, row, (uint8_t)(skip + 1));
        send_text(screen, text + skip);
    }
}

/* The bracket behind the work pose belongs to the label, but stands right of its cell. */
static void paint_bracket(screen_t *screen, uint8_t row, uint16_t marks)
{
    if ((marks & MARK_HEADER_LABEL) != 0) {
        go(screen, row, FRAME_BRACKET_COLUMN);
        send(screen, ']');
    }
}

static void paint_left(screen_t *screen, uint8_t y, uint16_t marks)
{
    uint8_t row = row_of(screen, y);
    if (row == 0) {
        return;
    }
    paint_label(screen, row, y, marks);
    for (uint8_t x = 0; x <= CELL_X_SOFTNESS; x++) {
        if ((marks >> x & 1u) != 0 && cell_kind(screen->session->page, x, y) != CELL_NONE) {
            paint_cell(screen, row, x, y);
        }
        if (x == CELL_X_POSE) {
            paint_bracket(screen, row, marks);
        }
        if (x <= PAGE_STEPS) {
            paint_marker(screen, row, y, x);
        }
    }
    set_marker_shown(screen, y);
}

static void paint_header(screen_t *screen, uint8_t y, uint16_t marks)
{
    if (y > CELL_Y_HEADER_LAST) {
        return;
    }
    uint8_t row = (uint8_t)(y + 1u);
    if ((marks & MARK_HEADER_LABEL) != 0) {
        char label[FRAME_LABEL_BYTES];
        uint8_t column = frame_header_label(y, label);
        if (label[0] != '\0') {
            go(screen, row, column);
            send_text(screen, label);
        }
    }
    if ((marks >> CELL_X_HEADER & 1u) == 0) {
        return;
    }
    if (y >= CELL_Y_HEADER) {
        paint_cell(screen, row, CELL_X_HEADER, y);
        return;
    }
    char text[FRAME_LABEL_BYTES];
    uint8_t column = frame_title_text(screen->session, y, text);
    go(screen, row, column);
    send_text(screen, text);
}

static bool marker_is_old(const screen_t *screen, uint8_t y)
{
    uint8_t steps = screen->session->cells[PAGE_AT_STEPS];
    uint8_t wanted = steps > PAGE_STEPS ? (uint8_t)MARK_STEP_NONE : steps;
    return y < PAGE_JOINTS && row_of(screen, y) != 0 && screen->session->marks[y] >> MARK_STEP_SHIFT != wanted;
}

static bool paint_row(screen_t *screen, uint8_t y)
{
    uint16_t marks = screen->session->marks[y] & 0x0FFFu;
    if (marks == 0 && !marker_is_old(screen, y)) {
        return false;
    }
    screen->session->marks[y] &= 0xF000u;
    paint_left(screen, y, marks);
    paint_header(screen, y, marks);
    return true;
}

/* ---- single items ---- */

static void paint_labels(screen_t *screen)
{
    go(screen, (uint8_t)(command_row(screen) - 1u), FRAME_POSE_COLUMN);
    send_text_P(screen, frame_labels_P);
    if (screen->session->page == 0) {
        go(screen, (uint8_t)(command_row(screen) - 1u), FRAME_POSE_COLUMN);
        send_text_P(screen, frame_labels_page0_P);
    }
}

static void paint_number(screen_t *screen, uint8_t column, uint16_t number, uint8_t digits)
{
    char text[CELLS_TEXT_BYTES];
    go(screen, row_of(screen, CELL_Y_SPEED), column);
    cell_digits(number, digits, screen->session->hex, text);
    text[digits] = '\0';
    send_text(screen, text);
}

static void paint_xya(screen_t *screen)
{
    const session_t *session = screen->session;
    paint_number(screen, 64, session->x, 2);
    paint_number(screen, 69, session->y, 2);
    paint_number(screen, 74, cell_address(session->x, session->y), 4);
}

static void paint_go(screen_t *screen)
{
    go(screen, (uint8_t)(command_row(screen) - 1u), FRAME_GO_COLUMN);
    if (screen->session->go_step == SESSION_NO_STEP) {
        send_spaces(screen, 3);
    } else {
        char text[CELLS_TEXT_BYTES];
        cell_byte_text(screen->session->go_step, screen->session->hex, text);
        send_text(screen, text);
    }
}

static void paint_unsaved(screen_t *screen)
{
    go(screen, (uint8_t)(command_row(screen) - 1u), 1);
    send_text_P(screen, screen->session->is_changed ? PSTR("* unsaved") : PSTR("         "));
}

static void paint_fault(screen_t *screen)
{
    char text[FRAME_FAULT_BYTES];
    go(screen, row_of(screen, CELL_Y_PAUSE), FRAME_FAULT_COLUMN);
    frame_fault_text(screen->shown_fault, text);
    send_text(screen, text);
}

static void paint_item(screen_t *screen, uint16_t item)
{
    switch (item) {
    case ITEM_CLEAR:
        ansi_clear();
        screen->at_row = 1;
        screen->at_column = 1;
        break;
    case ITEM_LABELS:
        paint_labels(screen);
        break;
    case ITEM_XYA_FRAME:
        go(screen, row_of(screen, CELL_Y_SPEED), FRAME_FAULT_COLUMN);
        send_text_P(screen, PSTR("[X:--,Y:--,A:----]"));
        break;
    case ITEM_XYA:
        paint_xya(screen);
        break;
    case ITEM_GO:
        paint_go(screen);
        break;
    case ITEM_UNSAVED:
        paint_unsaved(screen);
        break;
    case ITEM_FAULT:
        paint_fault(screen);
        break;
    default:
        go(screen, command_row(screen), 1);
        send_text_P(screen, screen->sink == SCREEN_QUIET ? PSTR("] _") : PSTR("] "));
        break;
    }
}

static bool paint_next_item(screen_t *screen, uint16_t among)
{
    for (uint16_t item = ITEM_CLEAR; item < ITEM_ALL; item = (uint16_t)(item << 1)) {
        if ((screen->items & among & item) != 0) {
            screen->items &= (uint16_t)~item;
            paint_item(screen, item);
            return true;
        }
    }
    return false;
}

static void rest(screen_t *screen)
{
    const session_t *session = screen->session;
    if (screen->sink == SCREEN_LINE) {
        go(screen, command_row(screen), screen->line_column);
        return;
    }
    uint8_t row = session->x == CELL_X_HEADER ? (uint8_t)(session->y + 1u) : row_of(screen, session->y);
    go(screen, row, frame_cell_column(session->x, session->y));
}

bool screen_paint(screen_t *screen)
{
    if (screen->hidden) {
        return false;
    }
    if (paint_next_item(screen, ITEM_CLEAR | ITEM_PROMPT)) {
        return true;
    }
    for (uint8_t y = 0; y < CELLS_ROWS; y++) {
        if (paint_row(screen, y)) {
            return true;
        }
    }
    if (paint_next_item(screen, ITEM_ALL)) {
        return true;
    }
    rest(screen);
    return false;
}

/* ---- what follows from the session ---- */

static uint8_t flags_of(const session_t *session)
{
    return (uint8_t)((session->is_changed ? SHOWN_UNSAVED : 0) | (session->hex ? SHOWN_HEX : 0) |
                     (session->page == 0 ? SHOWN_PAGE0 : 0));
}

void screen_sync(screen_t *screen)
{
    session_t *session = screen->session;
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

static void mark_frame(screen_t *screen)
{
    for (uint8_t y = 0; y < CELLS_ROWS; y++) {
        screen->session->marks[y] = MARK_CELLS | MARK_HEADER_LABEL | (uint16_t)MARK_STEP_NONE << MARK_STEP_SHIFT;
    }
}

void screen_redraw(screen_t *screen)
{
    mark_frame(screen);
    screen->items = ITEM_ALL;
    screen->at_row = 0;
}

void screen_init(screen_t *screen, session_t *session)
{
    screen->session = session;
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
    session_t *session = screen->session;
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
        mark_frame(screen);
    }
}

static void move_to_header(screen_t *screen)
{
    session_t *session = screen->session;
    uint8_t row = row_of(screen, session->y);
    if (row != 0 && cell_kind(session->page, CELL_X_HEADER, (uint8_t)(row - 1u)) != CELL_NONE) {
        session->x = CELL_X_HEADER;
        session->y = (uint8_t)(row - 1u);
    }
}

void screen_move(screen_t *screen, session_way_t way)
{
    session_t *session = screen->session;
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
    go(screen, command_row(screen), SCREEN_LINE_COLUMN);
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
        go(screen, command_row(screen), screen->line_column);
        ansi_put('\b');
        screen->line_column--;
        screen->at_column = screen->line_column;
    } else if (screen->line_column < SCREEN_COLUMNS) {
        go(screen, command_row(screen), screen->line_column);
        send(screen, character);
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
