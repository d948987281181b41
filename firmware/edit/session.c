/* SPDX-License-Identifier: MIT */
#include "session_parts.h"

#include <string.h>
#include "compiler.h"
#include "page_store.h"

session_t the_session;

/* A new page: editor-original.md section 1. */
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
    uint8_t place = (uint8_t)(offset % PAGE_STEP_BYTES);
    if (place >= PAGE_STEP_AT_PAUSE) {
        return place == PAGE_STEP_AT_SPEED ? NEW_STEP_SPEED : 0;
    }
    return (place & 1u) != 0 ? (uint8_t)(PAGE_POS_UNUSED >> 8) : 0;
}

/* ---- marks ---- */

NOINLINE void session_mark(uint8_t x, uint8_t y)
{
    the_session.marks[y] |= (uint16_t)(1u << x);
}

void session_mark_all(void)
{
    for (uint8_t y = 0; y < CELLS_ROWS; y++) {
        the_session.marks[y] |= MARK_CELLS;
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

void session_change_byte(uint16_t address, uint8_t bits)
{
    the_session.cells[address] ^= bits;
    mark_byte(address);
}

void session_set_byte(uint16_t address, uint8_t byte)
{
    uint8_t bits = the_session.cells[address] ^ byte;
    if (bits == 0) {
        return;
    }
    session_change_byte(address, bits);
    if (address < CELLS_POSE_AT) {
        undo_note(&the_session.undo, address, bits);
    }
}

NOINLINE void session_set_bytes(uint16_t address, const uint8_t *bytes, uint8_t count)
{
    while (count-- > 0) {
        session_set_byte(address++, *bytes++);
    }
}

void session_set_word(uint16_t address, uint16_t word)
{
    session_set_byte(address, (uint8_t)word);
    session_set_byte((uint16_t)(address + 1u), (uint8_t)(word >> 8));
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

NOINLINE uint16_t session_step_at(uint8_t step)
{
    return (uint16_t)(PAGE_AT_STEP0 + PAGE_STEP_BYTES * step);
}

uint16_t session_word(uint8_t step, uint8_t joint)
{
    return cell_word(the_session.cells, (uint16_t)(session_step_at(step) + 2u * joint));
}

uint8_t session_steps(void)
{
    uint8_t steps = the_session.cells[PAGE_AT_STEPS];
    return steps > PAGE_STEPS ? (uint8_t)PAGE_STEPS : steps;
}

void session_update_trim(uint8_t joint)
{
    uint16_t master = session_word(0, joint);
    uint16_t slave = session_word(1, joint);
    if (cell_is_position(master) && cell_is_position(slave)) {
        session_set_word(cell_address(CELL_X_OFFSET, joint), (uint16_t)(slave - master));
    }
}

/* ---- flash ---- */

/* Byte `offset` of flash page `page`. An erased page reads as a new one. */
static uint8_t stored_byte(uint8_t page, bool erased, uint16_t offset)
{
    return erased ? session_new_byte(offset) : page_store_byte(page, offset);
}

bool session_differs_from_flash(void)
{
    bool erased = page_store_is_erased(the_session.page);
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset++) {
        if (the_session.cells[offset] != stored_byte(the_session.page, erased, offset) && offset != PAGE_AT_CHECKSUM) {
            return true;
        }
    }
    return false;
}

static void fill(uint8_t from, bool erased)
{
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset++) {
        session_set_byte(offset, stored_byte(from, erased, offset));
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

void session_open(uint8_t page)
{
    if ((page == 0) != (the_session.page == 0)) {
        for (uint8_t y = 0; y < PAGE_JOINTS; y++) {
            session_mark(CELL_X_OFFSET, y);
        }
    }
    the_session.page = page;
    session_load(page);
    undo_clear(&the_session.undo);
    the_session.undo_reloads = false;
    the_session.spare_for = SESSION_SPARE_NONE;
    the_session.is_changed = false;
    session_mark(CELL_X_HEADER, CELL_Y_NUMBER);
    session_mark(CELL_X_HEADER, CELL_Y_ADDRESS);
}

void session_init(void)
{
    memset(&the_session, 0, sizeof the_session);
    undo_clear(&the_session.undo);
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
    undo_clear(&the_session.undo);
    session_mark_all();
    the_session.is_changed = session_differs_from_flash();
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

/* Moves up or down. Where a column ends, the cursor goes on in the one to the left. */
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
        enter_row((uint8_t)(the_session.y + 1u));
        break;
    case SESSION_RIGHT:
        enter((uint8_t)(the_session.x + 1u), the_session.y);
        break;
    case SESSION_LEFT:
        enter((uint8_t)(the_session.x - 1u), the_session.y);
        break;
    }
}
