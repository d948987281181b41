/* SPDX-License-Identifier: MIT */
#include "commands.h"

#include <stddef.h>
#include "compiler.h"
#include "pgm.h"
#include "text.h"


/* What the first and the second word are: low and high half of a byte. OWN: the handler looks itself. */
enum { OWN = 0, PAGE, PLAYED, STEP, STEP7, PERCENT, ROWS, X, Y };
#define BOTH(first, second) ((first) | (second) << 4)
TEXT_NAMED(name_page, "Page");
TEXT_NAMED(name_step, "Step");
TEXT_NAMED(name_percent, "Percent");
TEXT_NAMED(name_rows, "Rows");
TEXT_NAMED(name_x, "X");
TEXT_NAMED(name_y, "Y");
static const struct {
    const char *name;
    uint16_t min, max;
} kinds_P[] PROGMEM = {
    { NULL, 0, 0 },          { name_page, 0, PAGE_COUNT - 1 },         { name_page, 1, PAGE_COUNT - 1 },
    { name_step, 0, 6 },     { name_step, 0, 7 },                      { name_percent, 10, 1000 },
    { name_rows, SCREEN_ROWS_MIN, 255 }, { name_x, 0, CELLS_COLUMNS - 1 }, { name_y, 0, CELLS_ROWS - 1 },
};

TEXT_NAMED(word_page, "page p n  opens page n");
TEXT_NAMED(word_next, "next n page");
TEXT_NAMED(word_before, "before b page before");
TEXT_NAMED(word_copy, "copy  n  page n into the open page");
TEXT_NAMED(word_new, "new  empties the open page");
TEXT_NAMED(word_save, "save sav [n]  to the flash [as page n]");
TEXT_NAMED(word_exit, "exit  restarts the controller");
TEXT_NAMED(word_name, "name  [name]");
TEXT_NAMED(word_step, "step s n  steps");
TEXT_NAMED(word_go, "go g n  robot to step n");
TEXT_NAMED(word_write, "write w [n]  pose to the next step, or n");
TEXT_NAMED(word_insert, "insert i n  pose to a new step n");
TEXT_NAMED(word_delete, "delete d [n]  the last step, or step n");
TEXT_NAMED(word_move, "move  a b  step a over step b; 7: STP7");
TEXT_NAMED(word_swap, "swap  a b  exchanges two steps");
TEXT_NAMED(word_int, "int  a b [r]  a step between, at r % (50)");
TEXT_NAMED(word_scale, "scale  p  p % of its time");
TEXT_NAMED(word_take, "take  a [b]  notes steps for PASTE");
TEXT_NAMED(word_paste, "paste  [n]  the noted steps, behind or from n");
TEXT_NAMED(word_mirror, "mirror m n  robot to step n mirrored");
TEXT_NAMED(word_pairs, "pairs  [a b|512|page1]  pairs and middle of MIRROR");
TEXT_NAMED(word_set, "set  v  the cell");
TEXT_NAMED(word_goto, "goto  x y");
TEXT_NAMED(word_on, "on  [ids]  holds the pose");
TEXT_NAMED(word_off, "off  [ids]  lets go: pose by hand, ON, WRITE");
TEXT_NAMED(word_play, "play  [n]  CR stop, ESC end here, space break");
TEXT_NAMED(word_time, "time  time base");
TEXT_NAMED(word_speed, "speed  speed base");
TEXT_NAMED(word_undo, "undo u the last edit");
TEXT_NAMED(word_redo, "redo  ");
TEXT_NAMED(word_list, "list  [a [b]]  stored pages");
TEXT_NAMED(word_find, "find  text  pages by name");
TEXT_NAMED(word_check, "check  [n]  faults of stored pages");
TEXT_NAMED(word_re, "re  draws the screen anew");
TEXT_NAMED(word_rows, "rows  n  of the terminal");
TEXT_NAMED(word_hex, "hex  numbers");
TEXT_NAMED(word_dec, "dec  numbers");
TEXT_NAMED(word_balance, "balance  sensors 102, 101");
TEXT_NAMED(word_monitor, "monitor mon servo bus");
TEXT_NAMED(word_help, "help ? [command]");

/* In the order in which HELP lists them. */
const shell_command_t commands_table_P[] PROGMEM = {
    { word_page, cmd_page, SHELL_ARGS(1, 1), PAGE },
    { word_next, cmd_next, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_before, cmd_before, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_copy, cmd_copy, SHELL_ARGS(1, 1), PAGE },
    { word_new, cmd_new, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_save, cmd_save, SHELL_ARGS(0, 1), PAGE },
    { word_exit, cmd_exit, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_name, cmd_name, SHELL_ARGS(0, 1), OWN },
    { word_step, cmd_step, SHELL_ARGS(1, 1), STEP7 },
    { word_go, cmd_go, SHELL_ARGS(1, 1), STEP },
    { word_write, cmd_write, SHELL_ARGS(0, 1), STEP },
    { word_insert, cmd_insert, SHELL_ARGS(1, 1), STEP },
    { word_delete, cmd_delete, SHELL_ARGS(0, 1), STEP },
    { word_move, cmd_move, SHELL_ARGS(2, 2), BOTH(STEP7, STEP7) },
    { word_swap, cmd_swap, SHELL_ARGS(2, 2), BOTH(STEP, STEP) },
    { word_int, cmd_int, SHELL_ARGS(2, 3), BOTH(STEP, STEP) },
    { word_scale, cmd_scale, SHELL_ARGS(1, 1), PERCENT },
    { word_take, cmd_take, SHELL_ARGS(1, 2), BOTH(STEP, STEP) },
    { word_paste, cmd_paste, SHELL_ARGS(0, 1), STEP },
    { word_mirror, cmd_mirror, SHELL_ARGS(1, 1), STEP },
    { word_pairs, cmd_pairs, SHELL_ARGS(0, 2), OWN },
    { word_set, cmd_set, SHELL_ARGS(1, 1), OWN },
    { word_goto, cmd_goto, SHELL_ARGS(2, 2), BOTH(X, Y) },
    { word_on, cmd_on, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_off, cmd_off, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_play, cmd_play, SHELL_ARGS(0, 1), PLAYED },
    { word_time, cmd_time, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_speed, cmd_speed, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_undo, cmd_undo, SHELL_ARGS(0, 0), OWN },
    { word_redo, cmd_redo, SHELL_ARGS(0, 0), OWN },
    { word_list, cmd_list, SHELL_ARGS(0, 2), BOTH(PAGE, PAGE) },
    { word_find, cmd_find, SHELL_ARGS(1, 1), OWN },
    { word_check, cmd_check, SHELL_ARGS(0, 1), PLAYED },
    { word_re, cmd_re, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_rows, cmd_rows, SHELL_ARGS(1, 1), ROWS },
    { word_hex, cmd_hex, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_dec, cmd_dec, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_balance, cmd_balance, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_monitor, cmd_mon, SHELL_ARGS(0, SHELL_ANY_ARGS), OWN },
    { word_help, cmd_help, SHELL_ARGS(0, 1), OWN },
};
const uint8_t commands_count = ARRAY_COUNT(commands_table_P);

bool commands_numbers(void)
{
    const shell_command_t *command_P = shell_find(commands_table_P, commands_count, &the_editor.args, 0);
    uint8_t kinds = command_P == NULL ? (uint8_t)OWN : pgm_read_byte(&command_P->extra);
    for (uint8_t i = 0; i < ARRAY_COUNT(the_editor.args.number) && i + 1 < the_editor.args.count; i++, kinds >>= 4) {
        uint8_t kind = kinds & 15u;
        if (kind != OWN &&
            !shell_number(&the_editor.args, (uint8_t)(i + 1u), pgm_read_ptr(&kinds_P[kind].name),
                          pgm_read_word(&kinds_P[kind].min), pgm_read_word(&kinds_P[kind].max), &the_editor.args.number[i])) {
            return false;
        }
    }
    return true;
}
