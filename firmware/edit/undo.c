/* SPDX-License-Identifier: MIT */
#include "undo.h"

#include <stddef.h>
#include <string.h>

enum { RECORD_HEADER_BYTES = 3, RUN_HEADER_BYTES = 2, RUN_MAX_BYTES = 128 };

static uint16_t word_at(const undo_t *undo, uint16_t at)
{
    return (uint16_t)(undo->log[at] | (uint16_t)undo->log[at + 1] << 8);
}

static void put_word(undo_t *undo, uint16_t at, uint16_t word)
{
    undo->log[at] = (uint8_t)word;
    undo->log[at + 1] = (uint8_t)(word >> 8);
}

static uint16_t run_address(const undo_t *undo, uint16_t run)
{
    return word_at(undo, run) & 0x1FFu;
}

static uint8_t run_bytes(const undo_t *undo, uint16_t run)
{
    return (uint8_t)((word_at(undo, run) >> 9) + 1u);
}

static void set_run(undo_t *undo, uint16_t run, uint16_t address, uint8_t bytes)
{
    put_word(undo, run, (uint16_t)(address | (uint16_t)(bytes - 1u) << 9));
}

static uint16_t record_at(const undo_t *undo, uint8_t index)
{
    uint16_t at = 0;
    while (index > 0) {
        at += word_at(undo, at);
        index--;
    }
    return at;
}

static void drop_oldest(undo_t *undo)
{
    uint16_t bytes = word_at(undo, 0);
    memmove(undo->log, &undo->log[bytes], undo->used - bytes);
    undo->used -= bytes;
    undo->open_at -= bytes;
    if (undo->run_at != 0) {
        undo->run_at -= bytes;
    }
    undo->count--;
    undo->applied--;
}

/* Makes room for `bytes` more at the end of the open record by dropping the oldest records. */
static bool make_room(undo_t *undo, uint8_t bytes)
{
    while (undo->used + bytes > UNDO_BYTES && undo->count > 0) {
        drop_oldest(undo);
    }
    if (undo->used + bytes > UNDO_BYTES) {
        undo->lost = true;
    }
    return !undo->lost;
}

/* A new record drops those that could be redone. */
static void open_record(undo_t *undo)
{
    undo->used = record_at(undo, undo->applied);
    undo->count = undo->applied;
    undo->open_at = undo->used;
    undo->run_at = 0;
    undo->lost = false;
    undo->open = true;
    if (make_room(undo, RECORD_HEADER_BYTES)) {
        undo->log[undo->open_at + 2u] = undo->pending_turn;
        undo->used += RECORD_HEADER_BYTES;
    }
}

void undo_clear(undo_t *undo)
{
    memset(undo, 0, offsetof(undo_t, log));
}

void undo_begin(undo_t *undo, uint8_t turn)
{
    undo->pending_turn = turn;
    undo->open = false;
    if (turn != UNDO_TURN_NONE) {
        open_record(undo);
    }
}

static void append_byte(undo_t *undo, uint8_t bits)
{
    if (make_room(undo, 1)) {
        uint16_t run = undo->run_at;
        set_run(undo, run, run_address(undo, run), run_bytes(undo, run) + 1u);
        undo->log[undo->used++] = bits;
    }
}

static void append_run(undo_t *undo, uint16_t address, uint8_t bits)
{
    if (make_room(undo, RUN_HEADER_BYTES + 1)) {
        undo->run_at = undo->used;
        set_run(undo, undo->run_at, address, 1);
        undo->log[undo->used + RUN_HEADER_BYTES] = bits;
        undo->used += RUN_HEADER_BYTES + 1u;
    }
}

void undo_note(undo_t *undo, uint16_t address, uint8_t bits)
{
    if (bits == 0 || undo->lost) {
        return;
    }
    if (!undo->open) {
        open_record(undo);
    }
    if (undo->run_at == 0) {
        append_run(undo, address, bits);
        return;
    }
    uint8_t bytes = run_bytes(undo, undo->run_at);
    uint16_t end = run_address(undo, undo->run_at) + bytes;
    /* A gap of one byte is recorded as an unchanged byte, which is shorter than a new run. */
    if (address == end + 1u && bytes < RUN_MAX_BYTES - 1) {
        append_byte(undo, 0);
        end++;
    }
    if (address == end && bytes < RUN_MAX_BYTES - 1) {
        append_byte(undo, bits);
    } else {
        append_run(undo, address, bits);
    }
}

bool undo_end(undo_t *undo)
{
    bool kept = !undo->lost;
    if (undo->lost) {
        undo_clear(undo);
    } else if (undo->open) {
        put_word(undo, undo->open_at, undo->used - undo->open_at);
        undo->count++;
        undo->applied = undo->count;
        undo->open = false;
    }
    undo->pending_turn = UNDO_TURN_NONE;
    return kept;
}

static void flip_runs(const undo_t *undo, uint16_t record, const undo_target_t *target)
{
    const uint8_t *run = &undo->log[record];
    const uint8_t *end = run + word_at(undo, record);
    for (run += RECORD_HEADER_BYTES; run < end;) {
        uint16_t address = run[0] | (run[1] & 1u) << 8;
        uint8_t bytes = (run[1] >> 1) + 1u;
        for (run += RUN_HEADER_BYTES; bytes > 0; bytes--) {
            target->flip(address++, *run++);
        }
    }
}

/* Applies record `index`. The turn of the steps comes first in a redo and last in an undo. */
static void carry_out(const undo_t *undo, uint8_t index, const undo_target_t *target, bool back)
{
    uint16_t record = record_at(undo, index);
    uint8_t turn = undo->log[record + 2u];
    if (!back) {
        target->turn(turn, false);
    }
    flip_runs(undo, record, target);
    if (back) {
        target->turn(turn, true);
    }
}

bool undo_back(undo_t *undo, const undo_target_t *target)
{
    if (undo->applied == 0) {
        return false;
    }
    carry_out(undo, --undo->applied, target, true);
    return true;
}

bool undo_forth(undo_t *undo, const undo_target_t *target)
{
    if (undo->applied == undo->count) {
        return false;
    }
    carry_out(undo, undo->applied++, target, false);
    return true;
}
