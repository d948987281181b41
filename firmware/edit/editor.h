/* SPDX-License-Identifier: MIT
 * editor.h - the whole editor: start, and the work of the main loop. All other parts of Edit are below it:
 *
 *   main.c
 *     editor.c           start, a turn of the main loop, pages for the performer
 *       editor_keys.c    meaning of keys by mode; runs complete lines
 *         commands.c, cmd_*.c, requests_page.c    words and handlers
 *           dialog.c     questions, lists, messages
 *             robot.c, screen*.c   work pose and servos; the terminal's display
 *               frame.c, session.c, undo.c, cells.c, keys.c, ansi.c
 *
 * Each uses only files below it (tools/dev/check_circles). One instance; main loop only. editor_turn blocks no longer than
 * its slowest command. */
#ifndef EDITOR_H
#define EDITOR_H

#include <stdbool.h>
#include <stdint.h>

/* Call after text_init, board_start, page_store_init, settings_load, servo_link_scan and performer_init. notice_P: a message
 * for the first screen, shown until a line is typed; or NULL. */
void editor_init(const char *notice_P);

/* One turn of the main loop: keys, the tick's work, one piece of the screen. true: there is more to do now. */
bool editor_turn(void);

/* Takes one character of text; the function given to text_init calls it. */
void editor_put(char character);

#endif
