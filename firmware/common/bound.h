/* SPDX-License-Identifier: MIT
 * bound.h - how the performer reaches the parts that its init was given. For performer*.c only.
 * An image with one of each may have a bound.h of its own, found before this one, which names them: fixed addresses take
 * less code than pointers (firmware/edit/bound.h). They must be the parts that were given to init. */
#ifndef BOUND_H
#define BOUND_H

#define PERFORMER_SERVOS(performer) ((performer)->servos)
#define PERFORMER_SETTINGS(performer) ((performer)->settings)

#endif
