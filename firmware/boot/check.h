/* SPDX-License-Identifier: MIT
 * check.h - CHECK, the memory check of the 2005 manual, and ID. Reads only; the RAM test restores every byte. */
#ifndef CHECK_H
#define CHECK_H


/* Prints a map of the motion pages, then one line that begins with "CHECK" (RECOVERY.md explains both). */
void check_all(void);

/* Prints one line: versions, board, application. */
void check_id(void);

#endif
