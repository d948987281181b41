/* SPDX-License-Identifier: MIT
 * fuzz_image.h - a whole application on the PC: its real main() over the fakes, with the input as its terminal, its remote
 * and its servos' mishaps. fuzz_play.c and fuzz_edit.c say which application and what must hold in the end.
 *
 * Input: bytes of the line, but
 *   FE nn  nn ticks go by (FE FE: the byte itself)
 *   FD nn  servo 1 + (nn & 3): nn >> 2 are its faults (fake_bus.h); bit 7: its error byte becomes overload
 *   FC nn  the panel's buttons
 *   FB nn  a packet of the remote with nn */
#ifndef FUZZ_IMAGE_H
#define FUZZ_IMAGE_H

#include <stdbool.h>
#include "fuzz.h"

#define FUZZ_IMAGE_SERVOS 4u   /* IDs 1..4 */

/* The application's main (CMakeLists.txt renames it). */
int image_main(void);

/* Puts pages into the flash, before the start. */
void fuzz_image_pages(void);

/* What is typed when the input is over: the harness's own, asked for k = 0, 1, ... and given a third of a
 * second each (2 s for the first, which may end a play); NULL: the end. */
const char *fuzz_image_last_words(unsigned k);

/* Runs the application from reset to the end of the input, half a second beyond, and through the last words.
 * true: it got there; false: it restarted itself. */
bool fuzz_image_run(const uint8_t *data, size_t size);

/* What the terminal has heard since the last words but one. */
const char *fuzz_image_said(void);

#endif
