/* SPDX-License-Identifier: MIT
 * fuzz_image.h - a complete application on the PC: its real main() on the fakes. The input drives its terminal, its
 * remote and the faults of its servos. fuzz_play.c and fuzz_edit.c select the application and check the result.
 *
 * Input: bytes of the line, except
 *   FE nn  wait nn ticks (FE FE: the byte itself)
 *   FD nn  servo 1 + (nn & 3): nn >> 2 are its faults (fake_bus.h); bit 7: its error byte becomes overload
 *   FC nn  the panel's buttons
 *   FB nn  a packet of the remote with nn */
#ifndef FUZZ_IMAGE_H
#define FUZZ_IMAGE_H

#include <stdbool.h>
#include "fuzz.h"

#define FUZZ_IMAGE_SERVOS 4u   /* IDs 1..4 */

/* The application's main, renamed by CMakeLists.txt. */
int image_main(void);

/* Writes pages into the flash, before the start. */
void fuzz_image_pages(void);

/* Returns what the harness types after the input, for k = 0, 1, ...; NULL: the end. Each text is followed by a third
 * of a second (the first by 2 s, because it may end a play). */
const char *fuzz_image_last_words(unsigned k);

/* Runs the application from reset to the end of the input, half a second longer, and through the last words. Returns
 * true if it got there, false if it restarted itself. */
bool fuzz_image_run(const uint8_t *data, size_t size);

/* Returns the output since the last of the last words was typed. */
const char *fuzz_image_said(void);

#endif
