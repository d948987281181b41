/* SPDX-License-Identifier: MIT
 * program.h - start of Play and Edit on any machine of hal/host, once it is open. */
#ifndef PROGRAM_H
#define PROGRAM_H

int program_start(void);

#endif
