/* SPDX-License-Identifier: MIT
 * mon.h - what mon.c and mon_toss.c share. */
#ifndef MON_H
#define MON_H

#include "editor.h"

/* The PC speaks to the servos itself: packets from the console go to the bus as they are, everything heard on the bus
 * goes to the console. Three ESC outside a packet end it. Blocks until then; the watchdog is kicked. Uses the editor's
 * line and history buffers. */
void mon_toss(void);

#endif
