/* SPDX-License-Identifier: MIT */
#include "commands.h"

#include <stddef.h>
#include "compiler.h"
#include "pgm.h"
#include "ranges_own.h"
#include "text.h"

TEXT_NAMED(word_page, "page p n  opens page n");
TEXT_NAMED(word_next, "next n opens the next page");
TEXT_NAMED(word_before, "before b opens the page before");
TEXT_NAMED(word_copy, "copy  n  takes stored page n into this page");
TEXT_NAMED(word_new, "new  empties this page");
TEXT_NAMED(word_save, "save sav [n]  writes this page to flash [as page n]");
TEXT_NAMED(word_exit, "exit  restarts the controller, which finds new servos");
TEXT_NAMED(word_name, "name  [word]  names this page; several words: NAME alone");
TEXT_NAMED(word_step, "step s n  this page has n steps");
TEXT_NAMED(word_go, "go g n  moves the robot to step n");
TEXT_NAMED(word_write, "write w [n]  the pose becomes the next step, or step n");
TEXT_NAMED(word_insert, "insert i n  the pose becomes a new step n");
TEXT_NAMED(word_delete, "delete d [n]  removes the last step, or step n");
TEXT_NAMED(word_move, "move  a b  copies step a over step b; 7 is STP7");
TEXT_NAMED(word_swap, "swap  a b  exchanges two steps");
TEXT_NAMED(word_take, "take  a [b]  notes steps for PASTE");
TEXT_NAMED(word_paste, "paste  [n]  the noted steps, behind the last or from n on");
TEXT_NAMED(word_mirror, "mirror m n  moves the robot to step n mirrored");
TEXT_NAMED(word_pairs, "pairs  [a b|512|page1]  joints and middle of MIRROR");
TEXT_NAMED(word_set, "set  v  the cell becomes v");
TEXT_NAMED(word_goto, "goto  x y  moves the cursor");
TEXT_NAMED(word_on, "on  [ids]  holds the pose");
TEXT_NAMED(word_off, "off  [ids]  lets go: pose by hand, ON, WRITE");
TEXT_NAMED(word_play, "play  [n [rate]]  at rate %; CR stop, ESC end, space break");
TEXT_NAMED(word_time, "time  steps have times");
TEXT_NAMED(word_speed, "speed  steps have speeds");
TEXT_NAMED(word_undo, "undo u takes the last edit back");
TEXT_NAMED(word_redo, "redo  does it again");
TEXT_NAMED(word_list, "list  [a [b]]  stored pages");
TEXT_NAMED(word_re, "re  draws the screen again");
TEXT_NAMED(word_rows, "rows  n  the terminal has n rows");
TEXT_NAMED(word_hex, "hex  hexadecimal numbers, typed ones too");
TEXT_NAMED(word_dec, "dec  decimal numbers");
TEXT_NAMED(word_monitor, "monitor mon where it is");
TEXT_NAMED(word_help, "help ? [command]  this list, or a line of it");

/* In the order of HELP. */
const shell_command_t commands_table_P[] PROGMEM = {
    { word_page, cmd_page, SHELL_ARGS(1, 1) | SHELL_STILL, RANGE_PAGE },
    { word_next, cmd_next, SHELL_ARGS(0, 0) | SHELL_STILL, 0 },
    { word_before, cmd_before, SHELL_ARGS(0, 0) | SHELL_STILL, 0 },
    { word_copy, cmd_copy, SHELL_ARGS(1, 1) | SHELL_STILL, RANGE_PAGE },
    { word_new, cmd_new, SHELL_ARGS(0, 0) | SHELL_STILL, 0 },
    { word_save, cmd_save, SHELL_ARGS(0, 1) | SHELL_STILL, RANGE_PAGE },
    { word_exit, cmd_exit, SHELL_ARGS(0, 0) | SHELL_STILL, 0 },
    { word_name, cmd_name, SHELL_ARGS(0, 1) | SHELL_STILL, 0 },
    { word_step, cmd_step, SHELL_ARGS(1, 1) | SHELL_STILL, RANGE_STEP7 },
    { word_go, cmd_go, SHELL_ARGS(1, 1) | SHELL_STILL, RANGE_STEP },
    { word_write, cmd_write, SHELL_ARGS(0, 1) | SHELL_STILL, RANGE_STEP },
    { word_insert, cmd_insert, SHELL_ARGS(1, 1) | SHELL_STILL, RANGE_STEP },
    { word_delete, cmd_delete, SHELL_ARGS(0, 1) | SHELL_STILL, RANGE_STEP },
    { word_move, cmd_move, SHELL_ARGS(2, 2) | SHELL_STILL, SHELL_BOTH(RANGE_STEP7, RANGE_STEP7) },
    { word_swap, cmd_swap, SHELL_ARGS(2, 2) | SHELL_STILL, SHELL_BOTH(RANGE_STEP, RANGE_STEP) },
    { word_take, cmd_take, SHELL_ARGS(1, 2), SHELL_BOTH(RANGE_STEP, RANGE_STEP) },
    { word_paste, cmd_paste, SHELL_ARGS(0, 1) | SHELL_STILL, RANGE_STEP },
    { word_mirror, cmd_mirror, SHELL_ARGS(1, 1) | SHELL_STILL, RANGE_STEP },
    { word_pairs, cmd_pairs, SHELL_ARGS(0, 2), 0 },
    { word_set, cmd_set, SHELL_ARGS(1, 1) | SHELL_STILL, 0 },
    { word_goto, cmd_goto, SHELL_ARGS(2, 2), SHELL_BOTH(RANGE_X, RANGE_Y) },
    { word_on, cmd_on, SHELL_ARGS(0, SHELL_ANY_ARGS) | SHELL_STILL, 0 },
    { word_off, cmd_off, SHELL_ARGS(0, SHELL_ANY_ARGS), 0 },
    { word_play, cmd_play, SHELL_ARGS(0, 2) | SHELL_STILL, SHELL_BOTH(RANGE_PLAYED, RANGE_RATE) },
    { word_time, cmd_time, SHELL_ARGS(0, 0) | SHELL_STILL, 0 },
    { word_speed, cmd_speed, SHELL_ARGS(0, 0) | SHELL_STILL, 0 },
    { word_undo, cmd_undo, SHELL_ARGS(0, 0) | SHELL_STILL, 0 },
    { word_redo, cmd_redo, SHELL_ARGS(0, 0) | SHELL_STILL, 0 },
    { word_list, cmd_list, SHELL_ARGS(0, 2), SHELL_BOTH(RANGE_PAGE, RANGE_PAGE) },
    { word_re, cmd_re, SHELL_ARGS(0, 0), 0 },
    { word_rows, cmd_rows, SHELL_ARGS(1, 1), RANGE_ROWS },
    { word_hex, cmd_hex, SHELL_ARGS(0, 0), 0 },
    { word_dec, cmd_dec, SHELL_ARGS(0, 0), 0 },
    { word_monitor, cmd_mon, SHELL_ARGS(0, 0), 0 },
    { word_help, cmd_help, SHELL_ARGS(0, 1), 0 },
};
const uint8_t commands_count = ARRAY_COUNT(commands_table_P);
