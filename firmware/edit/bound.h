/* SPDX-License-Identifier: MIT
 * bound.h - takes the place of firmware/common/bound.h: the performer uses the editor's parts by name (parts.h). */
#ifndef BOUND_H
#define BOUND_H

#include "parts.h"

#define PERFORMER_SERVOS(performer) ((void)(performer), &the_servos)
#define PERFORMER_SETTINGS(performer) ((void)(performer), &the_settings)

#endif
