/* SPDX-License-Identifier: MIT
 * bound.h - the editor's answer to firmware/common/bound.h: the performer works with its only ones (parts.h). */
#ifndef BOUND_H
#define BOUND_H

#include "parts.h"

#define PERFORMER_SERVOS(performer) ((void)(performer), &the_servos)
#define PERFORMER_SETTINGS(performer) ((void)(performer), &the_settings)

#endif
