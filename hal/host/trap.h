/* SPDX-License-Identifier: MIT
 * trap.h - ASSERT, the PC's version: prints the place and aborts. */
#ifndef TRAP_H
#define TRAP_H

#include <stdio.h>
#include <stdlib.h>

#define ASSERT(condition) do { if (!(condition)) { \
    fprintf(stderr, "%s:%d: ASSERT(%s)\n", __FILE__, __LINE__, #condition); abort(); } } while (0)

#endif
