/* SPDX-License-Identifier: MIT
 * undo.h - the memory of what was edited, as differences: one record per editing command.
 * Knows bytes and addresses, nothing of pages, screens or servos. Caller-owned, main loop only.
 *
 * A record is a turn of the steps (a permutation, so it can be turned back) followed by runs of changed bits
 * (old XOR new), so that the same record undoes and redoes. Records lie one behind the other; the oldest are dropped
 * when a new one needs the room:
 *
 *   record = size (2 bytes, all of it) turn (1) { address:9 length-1:7 (2 bytes) bits (length bytes) }*
 *
 * RAM: UNDO_BYTES + 12. A WRITE of 18 joints takes 30 to 46 bytes, one cell 6 or 7, a full page of 18 joints
 * emptied about 300: the last eight commands are there even when each writes such a step. A single command that changes
 * more than fits (a whole page of more than 20 joints) empties the history; undo_end says so. */
#ifndef UNDO_H
#define UNDO_H

#include <stdbool.h>
#include <stdint.h>

#define UNDO_BYTES 372u
#define UNDO_SPACE_BYTES 512u   /* addresses 0..511 */

/* A permutation of whole steps: kind, first and second step. 0 = none. */
enum { UNDO_TURN_NONE = 0, UNDO_TURN_UP = 0x40, UNDO_TURN_DOWN = 0x80, UNDO_TURN_SWAP = 0xC0 };
#define UNDO_TURN(kind, first, second) ((uint8_t)((kind) | ((first) << 3) | (second)))

/* Who carries the changes out. */
typedef struct {
    void *context;
    void (*flip)(void *context, uint16_t address, uint8_t bits);      /* byte ^= bits */
    void (*turn)(void *context, uint8_t turn, bool back);             /* permute the steps, or back */
} undo_target_t;

typedef struct {
    uint16_t used;       /* bytes of log in use */
    uint16_t open_at;    /* where the record being written begins */
    uint16_t run_at;     /* where its last run begins; 0 = no run yet */
    uint8_t count;       /* finished records */
    uint8_t applied;     /* of these, how many are in force (the rest can be redone) */
    uint8_t pending_turn;
    bool open;
    bool lost;           /* the open record did not fit: the history ends here */
    uint8_t log[UNDO_BYTES];
} undo_t;

/* Forgets everything (another page was opened). */
void undo_clear(undo_t *undo);

/* An editing command begins. `turn` has been carried out already, or is UNDO_TURN_NONE. */
void undo_begin(undo_t *undo, uint8_t turn);

/* The byte at `address` has changed by `bits`. Shortest in ascending order. Ignored outside begin/end and for bits 0. */
void undo_note(undo_t *undo, uint16_t address, uint8_t bits);

/* The command is over. Without a change nothing is recorded and what can be redone stays. Returns false when the
 * change could not be recorded: the history is empty then. */
bool undo_end(undo_t *undo);

/* One command back or forth. false: there is none. */
bool undo_back(undo_t *undo, const undo_target_t *target);
bool undo_forth(undo_t *undo, const undo_target_t *target);

#endif
