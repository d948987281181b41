/* SPDX-License-Identifier: MIT
 * bound.h - the editor's answer to firmware/common/bound.h: performer and machine work with its only ones (parts.h). It
 * saves 850 bytes of flash: no pointer is passed, and the hooks of editor_image are called directly. */
#ifndef BOUND_H
#define BOUND_H

#include "editor_parts.h"

#define PERFORMER_SERVOS(performer) ((void)(performer), &the_servos)
#define PERFORMER_SETTINGS(performer) ((void)(performer), &the_settings)
#define MACHINE_PERFORMER(machine) ((void)(machine), &the_performer)
#define MACHINE_SERVOS(machine) ((void)(machine), &the_servos)
#define MACHINE_PAGES(machine) ((void)(machine), &the_pages)
#define MACHINE_IMAGE(machine) ((void)(machine), &editor_image)

#endif
