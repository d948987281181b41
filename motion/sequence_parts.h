/* SPDX-License-Identifier: MIT
 * sequence_parts.h - how the files of the sequence see each other. For sequence*.c only; law.h has what others call.
 *
 *   sequence_work.c        which piece of the work for the coming step is done in which tick
 *     sequence.c           which page and step come next
 *       sequence_read.c    reads a step, shapes it, measures its ways
 *
 * Each uses only files below it. */
#ifndef SEQUENCE_PARTS_H
#define SEQUENCE_PARTS_H

#include "law.h"

/* sequence_read.c */

/* Whether these settings, player.shape, change the play. NULL: they do not. */
bool sequence_shapes(const shape_t *shape);

/* Reads the coming step, or what the classic law looks at instead (sequence_looks_elsewhere), to looked_at; begins to shape
 * it. */
void sequence_read(player_t *player);

/* Reads the step that was looked at, and with the next calls shapes its shares. Only while shares_left is not 0. */
void sequence_shape_a_share(player_t *player);

#endif
