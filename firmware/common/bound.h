/* SPDX-License-Identifier: MIT
 * bound.h - where the performer finds the parts it works with: the ones handed to its init. For performer*.c alone.
 * An image that has one of each may bring a bound.h of its own, found before this one, which names them: addresses that
 * the compiler knows need no pointer (firmware/edit/bound.h). The named ones must be those handed to init. */
#ifndef BOUND_H
#define BOUND_H

#define PERFORMER_SERVOS(performer) ((performer)->servos)
#define PERFORMER_SETTINGS(performer) ((performer)->settings)

#endif
