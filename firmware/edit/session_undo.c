/* SPDX-License-Identifier: MIT
 * session_undo.c - begins and ends editing commands, undoes and redoes them. Small changes are noted (undo.h). A larger one
 * is undone from the spare page, which has the page as it was, until a play needs that memory. */
#include "session_parts.h"

#include <stddef.h>
#include <string.h>
#include "crc16.h"

static void begin(uint8_t turn)
{
    the_session.was_changed = the_session.is_changed;
    the_session.undo_reloads = false;
    the_session.spare_for = SESSION_SPARE_NONE;
    if (the_session.spare != NULL) {
        memcpy(the_session.spare, the_session.cells, PAGE_BYTES);
    }
    undo_begin(&the_session.undo, turn);
}

void session_begin(void)
{
    begin(UNDO_TURN_NONE);
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

/* Exchanges the page and the spare page, if that is intact and meant for this direction. */
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
            session_change_byte(address, bits);
        }
    }
    keep_spare(back ? SESSION_SPARE_REDO : SESSION_SPARE_UNDO);
    return true;
}

bool session_end(void)
{
    bool kept = undo_end(&the_session.undo);
    the_session.is_changed = session_differs_from_flash();
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
            session_change_byte(at_a, bits);
            session_change_byte(at_b, bits);
        }
    }
}

/* Permutes steps. UP first last: first -> first+1 -> .. -> last -> first; DOWN is its inverse. Rotations are made of swaps
 * of neighbours, which need no spare step. */
static void turn_steps(void *context __attribute__((unused)), uint8_t turn, bool back)
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
            swap_steps(step, (uint8_t)(step + 1u));
        }
    }
}

static void flip_byte(void *context __attribute__((unused)), uint16_t address, uint8_t bits)
{
    session_change_byte(address, bits);
}

void session_begin_turn(uint8_t turn)
{
    begin(turn);
    turn_steps(NULL, turn, false);
}

static NOINLINE bool travel(bool back)
{
    undo_target_t target = { NULL, flip_byte, turn_steps };
    bool done = (back ? undo_back(&the_session.undo, &target) : undo_forth(&the_session.undo, &target)) ||
                exchange_spare(back);
    if (!done && back && the_session.undo_reloads) {
        session_open(the_session.page);
        return true;
    }
    the_session.is_changed = session_differs_from_flash();
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
