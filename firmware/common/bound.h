/* SPDX-License-Identifier: MIT
 * bound.h - where performer and machine find the parts they work with: the ones handed to their init. For performer*.c and
 * machine*.c alone.
 * An image that has one of each may bring a bound.h of its own, found before this one, which names them: addresses that
 * the compiler knows need no pointer (firmware/edit/bound.h). The named ones must be those handed to init. */
#ifndef BOUND_H
#define BOUND_H

#define PERFORMER_SERVOS(performer) ((performer)->servos)
#define PERFORMER_SETTINGS(performer) ((performer)->settings)
#define MACHINE_PERFORMER(machine) ((machine)->performer)
#define MACHINE_SERVOS(machine) ((machine)->servos)
#define MACHINE_PAGES(machine) ((machine)->pages)
#define MACHINE_IMAGE(machine) ((machine)->image)

#endif
