/* SPDX-License-Identifier: MIT */
#include "session.h"

#include <stddef.h>
#include <string.h>
#include "compiler.h"
#include "crc16.h"
#include "page_store.h"

session_t the_session;

/* A new page: ORIGINAL.md section 1. */
enum { NEW_PLAY_COUNT = 1, NEW_STEP_SPEED = 64, NEW_LAST_SOFTNESS_AT = 63, ERASED = 0xFF };

uint8_t session_new_byte(uint16_t offset)
{
    if (offset == PAGE_AT_PLAY_COUNT) {
        return NEW_PLAY_COUNT;
    }
    if (offset == PAGE_AT_SPEED) {
        return PAGE_SPEED_NOMINAL;
    }
    if (offset == PAGE_AT_ACCEL_TIME) {
        return PAGE_ACCEL_DEFAULT;
    }
    if (offset < PAGE_AT_COMPLIANCE) {
        return 0;
    }
    if (offset <= NEW_LAST_SOFTNESS_AT) {
        return PAGE_COMPLIANCE_DEFAULT;
    }
    uint8_t place = offset % PAGE_STEP_BYTES;
    if (place >= PAGE_STEP_AT_PAUSE) {
        return place == PAGE_STEP_AT_SPEED ? NEW_STEP_SPEED : 0;
    }
    return (place & 1u) != 0 ? (uint8_t)(PAGE_POS_UNUSED >> 8) : 0;
}

/* ---- marks ---- */

void session_mark(uint8_t x, uint8_t y)
{
    the_session.marks[y] |= (uint16_t)(1u << x);
}

void session_mark_all(void)
{
    for (uint8_t y = 0; y < CELLS_ROWS; y++) {
        the_session.marks[y] |= MARK_CELLS;
    }
}

void session_mark_labels(void)
{
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        the_session.marks[joint] |= MARK_LABEL;
    }
}

/* Marks the cell of a changed byte, and the label that depends on it. */
static void mark_byte(uint16_t address)
{
    uint8_t x, y;
    if (cell_at(address, &x, &y)) {
        session_mark(x, y);
    }
    if (address == PAGE_AT_SCHEDULE) {
        the_session.marks[CELL_Y_SPEED] |= MARK_LABEL;
    }
}

/* ---- bytes ---- */

static void change_byte(uint16_t address, uint8_t bits)
{
    the_session.cells[address] ^= bits;
    mark_byte(address);
}

static void drop_spare(void)
{
    the_session.undo_reloads = false;
    the_session.spare_for = SESSION_SPARE_NONE;
}

/* Copies the page to the spare page before the first change of an edit. An edit that changes nothing keeps the spare page
 * and what it can undo. */
static void take_spare(void)
{
    if (!the_session.is_begun) {
        return;
    }
    the_session.is_begun = false;
    drop_spare();
    if (the_session.spare != NULL) {
        memcpy(the_session.spare, the_session.cells, PAGE_BYTES);
    }
}

void session_set_byte(uint16_t address, uint8_t byte)
{
    uint8_t bits = the_session.cells[address] ^ byte;
    if (bits == 0) {
        return;
    }
    if (address < CELLS_POSE_AT) {
        take_spare();
        undo_note(&the_session.undo, address, bits);
    }
    change_byte(address, bits);
}

void session_set_word(uint16_t address, uint16_t word)
{
    session_set_byte(address, (uint8_t)word);
    session_set_byte(address + 1u, (uint8_t)(word >> 8));
}

void session_set_steps(uint8_t steps)
{
    for (uint8_t step = the_session.cells[PAGE_AT_STEPS]; step < steps; step++) {
        const uint16_t time_at = session_step_at(step) + PAGE_STEP_AT_SPEED;
        if (the_session.cells[time_at] == 0) {
            session_set_byte(time_at, NEW_STEP_SPEED);
        }
    }
    session_set_byte(PAGE_AT_STEPS, steps);
}

void session_set_pose(uint8_t joint, uint16_t word)
{
    uint16_t address = (uint16_t)(CELLS_POSE_AT + 2u * joint);
    uint16_t old = cell_word(the_session.cells, address);
    if (old == word) {
        return;
    }
    the_session.cells[address] = (uint8_t)word;
    the_session.cells[address + 1u] = (uint8_t)(word >> 8);
    bool was_off = cell_is_off(old), is_off = cell_is_off(word);
    uint16_t marks = was_off || is_off ? MARK_LABEL : 0;
    if (!was_off || !is_off) {
        marks |= 1u << CELL_X_POSE;
    }
    the_session.marks[joint] |= marks;
}

uint16_t session_pose(uint8_t joint)
{
    return cell_word(the_session.cells, (uint16_t)(CELLS_POSE_AT + 2u * joint));
}

uint16_t session_step_at(uint8_t step)
{
    STATIC_ASSERT(PAGE_AT_STEP0 == PAGE_STEP_BYTES, "the header is as long as a step");
    /* 64 + 64 * step, as a product of two bytes: with 16 bits it would be a loop of shifts wherever it is inlined. */
    return (uint8_t)(step + 1u) * PAGE_STEP_BYTES;
}

uint16_t session_word(uint8_t step, uint8_t joint)
{
    return cell_word(the_session.cells, (uint16_t)(session_step_at(step) + 2u * joint));
}

uint8_t session_steps(void)
{
    uint8_t steps = the_session.cells[PAGE_AT_STEPS];
    return steps > PAGE_STEPS ? PAGE_STEPS : steps;
}

void session_update_trim(uint8_t joint)
{
    uint16_t master = session_word(0, joint);
    uint16_t slave = session_word(1, joint);
    if (cell_is_position(master) && cell_is_position(slave)) {
        session_set_word(cell_address(CELL_X_OFFSET, joint), slave - master);
    }
}

/* ---- flash ---- */

/* Byte `offset` of flash page `page`. An erased page reads as a new one. */
static uint8_t stored_byte(uint8_t page, bool erased, uint16_t offset)
{
    return erased ? session_new_byte(offset) : page_store_byte(page, offset);
}

static bool differs_from_flash(void)
{
    bool erased = page_store_is_erased(the_session.page);
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset++) {
        if (the_session.cells[offset] != stored_byte(the_session.page, erased, offset) && offset != PAGE_AT_CHECKSUM) {
            return true;
        }
    }
    return false;
}

/* In an edit, the checksum alone is no change: the next save sets it anyway. */
static void fill(uint8_t from, bool erased)
{
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset++) {
        if (offset != PAGE_AT_CHECKSUM || !the_session.is_begun) {
            session_set_byte(offset, stored_byte(from, erased, offset));
        }
    }
    the_session.was_damaged = !erased && page_store_look(from) == PAGE_ERR_CHECKSUM;
    the_session.go_step = SESSION_NO_STEP;
}

void session_load(uint8_t from)
{
    fill(from, page_store_is_erased(from));
}

void session_clear(void)
{
    fill(0, true);
}

/* The page has other contents now, from outside: no earlier edit can be undone in them. */
static void forget_edits(void)
{
    undo_clear(&the_session.undo);
    drop_spare();
}

void session_open(uint8_t page)
{
    if ((page == 0) != (the_session.page == 0)) {
        for (uint8_t y = 0; y < PAGE_JOINTS; y++) {
            session_mark(CELL_X_OFFSET, y);
        }
    }
    the_session.page = page;
    session_load(page);
    forget_edits();
    the_session.is_changed = false;
    session_mark(CELL_X_HEADER, CELL_Y_NUMBER);
    session_mark(CELL_X_HEADER, CELL_Y_ADDRESS);
}

void session_init(void)
{
    memset(&the_session, 0, sizeof the_session);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        session_set_pose(joint, PAGE_POS_UNUSED);
    }
    the_session.cells[CELLS_POSE_AT + PAGE_STEP_AT_SPEED] = NEW_STEP_SPEED;
    session_open(1);
}

void session_saved(void)
{
    the_session.was_damaged = false;
    the_session.undo_reloads = false;
    the_session.is_changed = false;
}

void session_replaced(void)
{
    forget_edits();
    session_mark_all();
    mark_byte(PAGE_AT_SCHEDULE);   /* its label, too */
    the_session.is_changed = differs_from_flash();
}

/* ---- checks ---- */

page_status_t session_check(void)
{
    return the_session.was_damaged ? PAGE_ERR_CHECKSUM : session_check_fields();
}

page_status_t session_check_fields(void)
{
    page_status_t status = page_check_header(the_session.cells);
    for (uint8_t step = 0; status == PAGE_OK && step < session_steps(); step++) {
        status = page_check_step(&the_session.cells[session_step_at(step)]);
    }
    return status;
}

bool session_is_empty(uint8_t page)
{
    if (page_store_is_erased(page)) {
        return true;
    }
    return page_store_byte(page, PAGE_AT_NAME) == 0 && page_store_byte(page, PAGE_AT_STEPS) == 0 &&
           page_store_look(page) != PAGE_ERR_CHECKSUM;
}

/* ---- cursor ---- */

static void enter(uint8_t x, uint8_t y)
{
    if (cell_kind(the_session.page, x, y) != CELL_NONE) {
        the_session.x = x;
        the_session.y = y;
    }
}

/* Moves up or down. Where a column ends, the cursor continues in the one to the left. */
static void enter_row(uint8_t y)
{
    uint8_t x = the_session.x;
    if (y >= CELLS_ROWS) {
        return;
    }
    while (cell_kind(the_session.page, x, y) == CELL_NONE) {
        x--;
    }
    enter(x, y);
}

void session_move(session_way_t way)
{
    switch (way) {
    case SESSION_UP:
        enter_row((uint8_t)(the_session.y - 1u));
        break;
    case SESSION_DOWN:
        enter_row(the_session.y + 1u);
        break;
    case SESSION_RIGHT:
        enter(the_session.x + 1u, the_session.y);
        break;
    case SESSION_LEFT:
        enter((uint8_t)(the_session.x - 1u), the_session.y);
        break;
    }
}

/* ---- editing commands and their undo ----
 *
 * Small changes are recorded (undo.h). A larger one is undone from the spare page, a copy of the previous page, until a
 * play needs that memory. */

void session_begin(void)
{
    the_session.was_changed = the_session.is_changed;
    the_session.is_begun = true;
    undo_begin(&the_session.undo, UNDO_TURN_NONE);
}

static uint16_t crc_of_spare(void)
{
    return crc16_bytes(CRC16_START, the_session.spare, PAGE_BYTES);
}

static void keep_spare(uint8_t what_for)
{
    if (the_session.spare != NULL) {
        the_session.spare_for = what_for;
        the_session.spare_crc = crc_of_spare();
    }
}

/* Swaps the page and the spare page, if the spare page is intact and meant for this direction. */
static bool exchange_spare(bool back)
{
    if (the_session.spare == NULL || the_session.spare_for != (back ? SESSION_SPARE_UNDO : SESSION_SPARE_REDO) ||
        the_session.spare_crc != crc_of_spare()) {
        return false;
    }
    for (uint16_t address = 0; address < PAGE_BYTES; address++) {
        uint8_t bits = the_session.spare[address] ^ the_session.cells[address];
        if (bits != 0) {
            the_session.spare[address] ^= bits;
            change_byte(address, bits);
        }
    }
    keep_spare(back ? SESSION_SPARE_REDO : SESSION_SPARE_UNDO);
    return true;
}

bool session_end(void)
{
    bool kept = undo_end(&the_session.undo);
    the_session.is_begun = false;
    the_session.is_changed = differs_from_flash();
    if (kept) {
        return true;
    }
    the_session.undo_reloads = !the_session.was_changed;
    keep_spare(SESSION_SPARE_UNDO);
    return the_session.undo_reloads || the_session.spare_for != SESSION_SPARE_NONE;
}

static void swap_steps(uint8_t a, uint8_t b)
{
    uint16_t at_a = session_step_at(a), at_b = session_step_at(b);
    for (uint8_t i = 0; i < PAGE_STEP_BYTES; i++, at_a++, at_b++) {
        uint8_t bits = the_session.cells[at_a] ^ the_session.cells[at_b];
        if (bits != 0) {
            take_spare();
            change_byte(at_a, bits);
            change_byte(at_b, bits);
        }
    }
}

/* Permutes steps. UP first last: first -> first+1 -> .. -> last -> first; DOWN is its inverse. Rotations consist of swaps of
 * neighbours, which need no spare step. */
static void turn_steps(uint8_t turn, bool back)
{
    uint8_t first = (turn >> 3) & 7u;
    uint8_t last = turn & 7u;
    uint8_t kind = turn & 0xC0u;
    if (kind == UNDO_TURN_SWAP) {
        swap_steps(first, last);
        return;
    }
    if (kind == UNDO_TURN_NONE) {
        return;
    }
    if ((kind == UNDO_TURN_UP) != back) {
        for (uint8_t step = last; step > first; step--) {
            swap_steps((uint8_t)(step - 1u), step);
        }
    } else {
        for (uint8_t step = first; step < last; step++) {
            swap_steps(step, step + 1u);
        }
    }
}

void session_begin_turn(uint8_t turn)
{
    session_begin();
    turn_steps(turn, false);
    if (!the_session.is_begun) {   /* equal steps: nothing has turned */
        undo_begin(&the_session.undo, turn);
    }
}

static bool travel(bool back)
{
    undo_target_t target;   /* without an initializer: that would stand in RAM */
    target.flip = change_byte;
    target.turn = turn_steps;
    bool done = (back ? undo_back(&the_session.undo, &target) : undo_forth(&the_session.undo, &target)) ||
                exchange_spare(back);
    if (!done && back && the_session.undo_reloads) {
        session_open(the_session.page);
        return true;
    }
    the_session.is_changed = differs_from_flash();
    return done;
}

bool session_undo(void)
{
    return travel(true);
}

bool session_redo(void)
{
    return travel(false);
}
