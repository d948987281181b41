/* SPDX-License-Identifier: MIT
 * parts.h - the parts of which the editor has one, defined in main.c. What joins several of them (commands, robot,
 * screen, editor) names them: an address that the compiler knows saves 1 KB of flash against pointers in every struct.
 * The logic below (session, undo, cells, keys, frame) is handed its state as everywhere, and is tested with its own. */
#ifndef PARTS_H
#define PARTS_H

#include "page_store.h"
#include "performer.h"
#include "servo_link.h"
#include "session.h"
#include "settings.h"

extern page_store_t the_pages;     /* the motion pages in flash */
extern servo_link_t the_servos;
extern performer_t the_performer;
extern settings_t the_settings;
extern settings_store_t the_settings_store;

#endif
