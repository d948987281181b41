/* SPDX-License-Identifier: MIT */
#include "session.h"

#include <string.h>
#include "compiler.h"
#include "crc16.h"
#include "page_store.h"

/* The new page of editor-original.md section 1. */
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

void session_mark(session_t *session, uint8_t x, uint8_t y)
{
    session->marks[y] |= (uint16_t)(1u << x);
}

void session_mark_all(session_t *session)
{
    for (uint8_t y = 0; y < CELLS_ROWS; y++) {
        session->marks[y] |= MARK_CELLS;
    }
}

/* A changed byte: its cell, and what else is made of it. */
static void mark_byte(session_t *session, uint16_t address)
{
    uint8_t x, y;
    if (cell_at(address, &x, &y)) {
        session_mark(session, x, y);
    }
    if (address == PAGE_AT_SCHEDULE) {
        session->marks[CELL_Y_SPEED] |= MARK_LABEL;
    }
}

/* ---- bytes ---- */

static void change_byte(session_t *session, uint16_t address, uint8_t bits)
{
    session->cells[address] ^= bits;
    mark_byte(session, address);
}

void session_set_byte(session_t *session, uint16_t address, uint8_t byte)
{
    uint8_t bits = session->cells[address] ^ byte;
    if (bits == 0) {
        return;
    }
    change_byte(session, address, bits);
    if (address < CELLS_POSE_AT) {
        undo_note(&session->undo, address, bits);
    }
}

void session_set_word(session_t *session, uint16_t address, uint16_t word)
{
    session_set_byte(session, address, (uint8_t)word);
    session_set_byte(session, (uint16_t)(address + 1u), (uint8_t)(word >> 8));
}

void session_set_pose(session_t *session, uint8_t joint, uint16_t word)
{
    uint16_t address = (uint16_t)(CELLS_POSE_AT + 2u * joint);
    uint16_t old = cell_word(session->cells, address);
    if (old == word) {
        return;
    }
    session->cells[address] = (uint8_t)word;
    session->cells[address + 1u] = (uint8_t)(word >> 8);
    bool was_off = cell_is_off(old), is_off = cell_is_off(word);
    uint16_t marks = was_off || is_off ? MARK_LABEL : 0;
    if (!was_off || !is_off) {
        marks |= 1u << CELL_X_POSE;
    }
    session->marks[joint] |= marks;
}

uint16_t session_pose(const session_t *session, uint8_t joint)
{
    return cell_word(session->cells, (uint16_t)(CELLS_POSE_AT + 2u * joint));
}

uint16_t session_word(const session_t *session, uint8_t step, uint8_t joint)
{
    return page_pos(session->cells, step, joint);
}

uint8_t session_steps(const session_t *session)
{
    uint8_t steps = session->cells[PAGE_AT_STEPS];
    return steps > PAGE_STEPS ? (uint8_t)PAGE_STEPS : steps;
}

void session_update_trim(session_t *session, uint8_t joint)
{
    uint16_t master = session_word(session, 0, joint);
    uint16_t slave = session_word(session, 1, joint);
    if (cell_is_position(master) && cell_is_position(slave)) {
        session_set_word(session, cell_address(CELL_X_OFFSET, joint), (uint16_t)(slave - master));
    }
}

/* ---- flash ---- */

/* Byte `offset` of flash page `page` as it is edited: an erased page reads as a new one. */
static uint8_t stored_byte(uint8_t page, bool erased, uint16_t offset)
{
    return erased ? session_new_byte(offset) : page_store_byte(page, offset);
}

/* Byte 31 is not edited and not compared: SAVE makes it. 2 ms when nothing differs. */
static bool differs_from_flash(const session_t *session)
{
    bool erased = page_store_is_erased(session->page);
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset++) {
        if (session->cells[offset] != stored_byte(session->page, erased, offset) && offset != PAGE_AT_CHECKSUM) {
            return true;
        }
    }
    return false;
}

static void fill(session_t *session, uint8_t from, bool erased)
{
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset++) {
        session_set_byte(session, offset, stored_byte(from, erased, offset));
    }
    session->was_damaged = !erased && page_store_look(from) == PAGE_ERR_CHECKSUM;
    session->go_step = SESSION_NO_STEP;
}

void session_load(session_t *session, uint8_t from)
{
    fill(session, from, page_store_is_erased(from));
}

void session_clear(session_t *session)
{
    fill(session, 0, true);
}

void session_open(session_t *session, uint8_t page)
{
    if ((page == 0) != (session->page == 0)) {
        for (uint8_t y = 0; y < PAGE_JOINTS; y++) {
            session_mark(session, CELL_X_OFFSET, y);
        }
    }
    session->page = page;
    undo_clear(&session->undo);
    session_load(session, page);
    undo_clear(&session->undo);
    session->undo_reloads = false;
    session->spare_for = SESSION_SPARE_NONE;
    session->is_changed = false;
    session_mark(session, CELL_X_HEADER, CELL_Y_NUMBER);
    session_mark(session, CELL_X_HEADER, CELL_Y_ADDRESS);
}

void session_init(session_t *session)
{
    memset(session, 0, sizeof *session);
    undo_clear(&session->undo);
    for (uint8_t joint = 0; joint < PAGE_JOINTS; joint++) {
        session_set_pose(session, joint, PAGE_POS_TORQUE_OFF);
    }
    session->cells[CELLS_POSE_AT + PAGE_STEP_AT_SPEED] = NEW_STEP_SPEED;
    session_open(session, 1);
}

void session_saved(session_t *session)
{
    session->was_damaged = false;
    session->undo_reloads = false;
    session->is_changed = differs_from_flash(session);
}

/* ---- editing commands ---- */

static void begin(session_t *session, uint8_t turn)
{
    session->was_changed = session->is_changed;
    session->undo_reloads = false;
    session->spare_for = SESSION_SPARE_NONE;
    if (session->spare != NULL) {
        memcpy(session->spare, session->cells, PAGE_BYTES);
    }
    undo_begin(&session->undo, turn);
}

void session_begin(session_t *session)
{
    begin(session, UNDO_TURN_NONE);
}

static uint16_t crc_of_spare(const session_t *session)
{
    return crc16_bytes(CRC16_START, session->spare, PAGE_BYTES);
}

static void keep_spare(session_t *session, uint8_t what_for)
{
    if (session->spare != NULL) {
        session->spare_for = what_for;
        session->spare_crc = crc_of_spare(session);
    }
}

/* Exchanges the page and the spare one, if that is as it was left and meant for this. */
static bool exchange_spare(session_t *session, bool back)
{
    if (session->spare == NULL || session->spare_for != (back ? SESSION_SPARE_UNDO : SESSION_SPARE_REDO) ||
        session->spare_crc != crc_of_spare(session)) {
        return false;
    }
    for (uint16_t address = 0; address < PAGE_BYTES; address++) {
        uint8_t bits = session->spare[address] ^ session->cells[address];
        if (bits != 0) {
            session->spare[address] ^= bits;
            change_byte(session, address, bits);
        }
    }
    keep_spare(session, back ? SESSION_SPARE_REDO : SESSION_SPARE_UNDO);
    return true;
}

bool session_end(session_t *session)
{
    bool kept = undo_end(&session->undo);
    session->is_changed = differs_from_flash(session);
    if (kept) {
        return true;
    }
    session->undo_reloads = !session->was_changed;
    keep_spare(session, SESSION_SPARE_UNDO);
    return session->undo_reloads || session->spare_for != SESSION_SPARE_NONE;
}

static void swap_steps(session_t *session, uint8_t a, uint8_t b)
{
    uint16_t at_a = (uint16_t)(PAGE_AT_STEP0 + PAGE_STEP_BYTES * a);
    uint16_t at_b = (uint16_t)(PAGE_AT_STEP0 + PAGE_STEP_BYTES * b);
    for (uint8_t i = 0; i < PAGE_STEP_BYTES; i++, at_a++, at_b++) {
        uint8_t bits = session->cells[at_a] ^ session->cells[at_b];
        if (bits != 0) {
            change_byte(session, at_a, bits);
            change_byte(session, at_b, bits);
        }
    }
}

/* UP first last: first -> first+1 -> .. -> last -> first. DOWN is the way back. Rotations are made of swaps of
 * neighbours, so nothing needs a spare step. */
static void turn_steps(void *context, uint8_t turn, bool back)
{
    session_t *session = context;
    uint8_t first = (turn >> 3) & 7u;
    uint8_t last = turn & 7u;
    uint8_t kind = turn & 0xC0u;
    if (kind == UNDO_TURN_SWAP) {
        swap_steps(session, first, last);
        return;
    }
    if (kind == UNDO_TURN_NONE) {
        return;
    }
    if ((kind == UNDO_TURN_UP) != back) {
        for (uint8_t step = last; step > first; step--) {
            swap_steps(session, (uint8_t)(step - 1u), step);
        }
    } else {
        for (uint8_t step = first; step < last; step++) {
            swap_steps(session, step, (uint8_t)(step + 1u));
        }
    }
}

static void flip_byte(void *context, uint16_t address, uint8_t bits)
{
    change_byte(context, address, bits);
}

void session_begin_turn(session_t *session, uint8_t turn)
{
    begin(session, turn);
    turn_steps(session, turn, false);
}

static NOINLINE bool travel(session_t *session, bool back)
{
    undo_target_t target = { session, flip_byte, turn_steps };
    bool done = (back ? undo_back(&session->undo, &target) : undo_forth(&session->undo, &target)) ||
                exchange_spare(session, back);
    if (!done && back && session->undo_reloads) {
        session_open(session, session->page);
        return true;
    }
    session->is_changed = differs_from_flash(session);
    return done;
}

bool session_undo(session_t *session)
{
    return travel(session, true);
}

bool session_redo(session_t *session)
{
    return travel(session, false);
}

/* ---- checks ---- */

page_status_t session_check(const session_t *session)
{
    if (session->was_damaged) {
        return PAGE_ERR_CHECKSUM;
    }
    page_status_t status = page_check_header(session->cells);
    for (uint8_t step = 0; status == PAGE_OK && step < session_steps(session); step++) {
        status = page_check_step(&session->cells[PAGE_AT_STEP0 + PAGE_STEP_BYTES * step]);
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

static void enter(session_t *session, uint8_t x, uint8_t y)
{
    if (cell_kind(session->page, x, y) != CELL_NONE) {
        session->x = x;
        session->y = y;
    }
}

/* Up and down: where a column ends, the one left of it goes on. */
static void enter_row(session_t *session, uint8_t y)
{
    uint8_t x = session->x;
    if (y >= CELLS_ROWS) {
        return;
    }
    while (cell_kind(session->page, x, y) == CELL_NONE) {
        x--;
    }
    enter(session, x, y);
}

void session_move(session_t *session, session_way_t way)
{
    switch (way) {
    case SESSION_UP:
        enter_row(session, (uint8_t)(session->y - 1u));
        break;
    case SESSION_DOWN:
        enter_row(session, (uint8_t)(session->y + 1u));
        break;
    case SESSION_RIGHT:
        enter(session, (uint8_t)(session->x + 1u), session->y);
        break;
    case SESSION_LEFT:
        enter(session, (uint8_t)(session->x - 1u), session->y);
        break;
    }
}
