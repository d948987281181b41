/* SPDX-License-Identifier: MIT
 * undo.h - the undo history: one record of changed bits per editing command.
 * Knows bytes and addresses, nothing of pages, screens or servos. Caller-owned, main loop only.
 *
 * A record is a turn of the steps (a permutation, which can be inverted) followed by runs of changed bits (old XOR new),
 * so that the same record undoes and redoes. Records are contiguous; the oldest are dropped when a new one needs the
 * room:
 *
 *   record = size (2 bytes, all of it) turn (1) { address:9 length-1:7 (2 bytes) bits (length bytes) }*
 *
 * A WRITE of 18 joints takes 30 to 46 bytes, one cell 6 or 7, clearing a full page of 18 joints about 300. So at least the
 * last eight commands can be undone. A single command that does not fit (a whole page of more than 20 joints) empties the
 * history; undo_end reports it. */
#ifndef UNDO_H
#define UNDO_H

#include <stdbool.h>
#include <stdint.h>

#define UNDO_BYTES 372u
#define UNDO_SPACE_BYTES 512u   /* addresses 0..511 */

/* A permutation of whole steps: kind, first and second step. 0 = none. */
enum { UNDO_TURN_NONE = 0, UNDO_TURN_UP = 0x40, UNDO_TURN_DOWN = 0x80, UNDO_TURN_SWAP = 0xC0 };
#define UNDO_TURN(kind, first, second) ((uint8_t)((kind) | ((first) << 3) | (second)))

/* The functions that change the page. */
typedef struct {
    void (*flip)(uint16_t address, uint8_t bits);      /* byte ^= bits */
    void (*turn)(uint8_t turn, bool back);             /* permute the steps; back: the inverse */
} undo_target_t;

typedef struct {
    uint16_t used;       /* bytes of log in use */
    uint16_t open_at;    /* where the record being written begins */
    uint16_t run_at;     /* where its last run begins; 0 = no run yet */
    uint8_t count;       /* finished records */
    uint8_t applied;     /* how many of them are applied (the rest can be redone) */
    uint8_t pending_turn;
    bool open;
    bool lost;           /* the open record did not fit: the history ends here */
    uint8_t log[UNDO_BYTES];
} undo_t;

/* Empties the history. */
void undo_clear(undo_t *undo);

/* Begins a record. `turn` has been carried out already, or is UNDO_TURN_NONE. */
void undo_begin(undo_t *undo, uint8_t turn);

/* Records that the byte at `address` has changed by `bits`. Ascending addresses take the least room. No effect if `bits` is
 * 0. */
void undo_note(undo_t *undo, uint16_t address, uint8_t bits);

/* Ends the record. If nothing has changed, there is no record and redo stays possible. false: the change did not fit; the
 * history is empty. */
bool undo_end(undo_t *undo);

/* Undoes or redoes one command. false: there is none. */
bool undo_back(undo_t *undo, const undo_target_t *target);
bool undo_forth(undo_t *undo, const undo_target_t *target);

#endif
