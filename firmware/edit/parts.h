/* SPDX-License-Identifier: MIT
 * parts.h - the editor's single instance of each part, defined in main.c. Files that combine several parts (commands,
 * robot, screen, editor) use them by name: fixed addresses save 1 KB of flash over pointers in every struct. */
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
extern settings_store_t the_settings_store;

#endif
