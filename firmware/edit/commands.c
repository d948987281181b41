/* SPDX-License-Identifier: MIT */
#include "commands.h"

#include "compiler.h"
#include "pgm.h"
#include "text.h"

TEXT_NAMED(help_page, "n  opens page n");
TEXT_NAMED(help_next, "page");
TEXT_NAMED(help_before, "page before");
TEXT_NAMED(help_copy, "n  page n into the open page");
TEXT_NAMED(help_new, "empties the open page");
TEXT_NAMED(help_save, "[n]  into the flash [as page n]");
TEXT_NAMED(help_exit, "restarts the controller");
TEXT_NAMED(help_name, "[name]");
TEXT_NAMED(help_step, "n  steps");
TEXT_NAMED(help_go, "n  robot to step n");
TEXT_NAMED(help_write, "[n]  robot's pose to the next step, or step n");
TEXT_NAMED(help_insert, "n  robot's pose to a new step n");
TEXT_NAMED(help_delete, "[n]  the last step, or step n");
TEXT_NAMED(help_move, "a b  copies step a over step b; 7 is STP7");
TEXT_NAMED(help_swap, "a b  exchanges two steps");
TEXT_NAMED(help_int, "a b [r]  new step behind a, r % (50) of the way to b");
TEXT_NAMED(help_scale, "p  the page takes p % of its time");
TEXT_NAMED(help_take, "a [b]  notes steps for PASTE");
TEXT_NAMED(help_paste, "[n]  the noted steps behind the last, or from n on");
TEXT_NAMED(help_mirror, "n  robot to the mirror of step n");
TEXT_NAMED(help_pairs, "[a b|512|page1]  pairs and middle of MIRROR");
TEXT_NAMED(help_set, "v  the cell");
TEXT_NAMED(help_goto, "x y");
TEXT_NAMED(help_on, "[ids]  holds the pose");
TEXT_NAMED(help_off, "[ids]  lets go: pose by hand, ON, WRITE");
TEXT_NAMED(help_play, "[n]  CR stop, ESC end here, space break");
TEXT_NAMED(help_time, "time base");
TEXT_NAMED(help_speed, "speed base");
TEXT_NAMED(help_re, "draws the screen anew");
TEXT_NAMED(help_rows, "n  of the terminal");
TEXT_NAMED(help_hex, "numbers");
TEXT_NAMED(help_dec, "numbers");
TEXT_NAMED(help_undo, "the last edit");
TEXT_NAMED(help_redo, "");
TEXT_NAMED(help_list, "[a [b]]  stored pages");
TEXT_NAMED(help_find, "text  pages by name");
TEXT_NAMED(help_check, "[n]  faults of stored pages");
TEXT_NAMED(help_balance, "sensors 102, 101");
TEXT_NAMED(help_mon, "servo bus");
TEXT_NAMED(help_help, "[command]");

/* In the order in which HELP lists them. */
const shell_command_t commands_table_P[] PROGMEM = {
    { "page", "p", 1, 1, cmd_page, help_page },
    { "next", "n", 0, SHELL_ANY_ARGS, cmd_next, help_next },
    { "before", "b", 0, SHELL_ANY_ARGS, cmd_before, help_before },
    { "copy", "", 1, 1, cmd_copy, help_copy },
    { "new", "", 0, SHELL_ANY_ARGS, cmd_new, help_new },
    { "save", "sav", 0, 1, cmd_save, help_save },
    { "exit", "", 0, SHELL_ANY_ARGS, cmd_exit, help_exit },
    { "name", "", 0, 1, cmd_name, help_name },
    { "step", "s", 1, 1, cmd_step, help_step },
    { "go", "g", 1, 1, cmd_go, help_go },
    { "write", "w", 0, 1, cmd_write, help_write },
    { "insert", "i", 1, 1, cmd_insert, help_insert },
    { "delete", "d", 0, 1, cmd_delete, help_delete },
    { "move", "", 2, 2, cmd_move, help_move },
    { "swap", "", 2, 2, cmd_swap, help_swap },
    { "int", "", 2, 3, cmd_int, help_int },
    { "scale", "", 1, 1, cmd_scale, help_scale },
    { "take", "", 1, 2, cmd_take, help_take },
    { "paste", "", 0, 1, cmd_paste, help_paste },
    { "mirror", "m", 1, 1, cmd_mirror, help_mirror },
    { "pairs", "", 0, 2, cmd_pairs, help_pairs },
    { "set", "", 1, 1, cmd_set, help_set },
    { "goto", "", 2, 2, cmd_goto, help_goto },
    { "on", "", 0, SHELL_ANY_ARGS, cmd_on, help_on },
    { "off", "", 0, SHELL_ANY_ARGS, cmd_off, help_off },
    { "play", "", 0, 1, cmd_play, help_play },
    { "time", "", 0, SHELL_ANY_ARGS, cmd_time, help_time },
    { "speed", "", 0, SHELL_ANY_ARGS, cmd_speed, help_speed },
    { "undo", "u", 0, 0, cmd_undo, help_undo },
    { "redo", "", 0, 0, cmd_redo, help_redo },
    { "list", "", 0, 2, cmd_list, help_list },
    { "find", "", 1, 1, cmd_find, help_find },
    { "check", "", 0, 1, cmd_check, help_check },
    { "re", "", 0, SHELL_ANY_ARGS, cmd_re, help_re },
    { "rows", "", 1, 1, cmd_rows, help_rows },
    { "hex", "", 0, SHELL_ANY_ARGS, cmd_hex, help_hex },
    { "dec", "", 0, SHELL_ANY_ARGS, cmd_dec, help_dec },
    { "balance", "", 0, SHELL_ANY_ARGS, cmd_balance, help_balance },
    { "monitor", "mon", 0, SHELL_ANY_ARGS, cmd_mon, help_mon },
    { "help", "?", 0, 1, cmd_help, help_help },
};
const uint8_t commands_count = ARRAY_COUNT(commands_table_P);

/* What the first and the second word are: low and high half of a byte. OWN: the handler looks itself. */
enum { OWN = 0, PAGE, PLAYED, STEP, STEP7, PERCENT, ROWS, X, Y };
static const struct {
    char name[8];
    uint16_t min, max;
} kinds_P[] PROGMEM = {
    { "", 0, 0 },         { "Page", 0, PAGE_COUNT - 1 }, { "Page", 1, PAGE_COUNT - 1 },
    { "Step", 0, 6 },     { "Step", 0, 7 },              { "Percent", 10, 1000 },
    { "Rows", SCREEN_ROWS_MIN, 255 }, { "X", 0, CELLS_COLUMNS - 1 }, { "Y", 0, CELLS_ROWS - 1 },
};
#define WORDS(first, second) ((first) | (second) << 4)
static const struct {
    shell_handler_t handler;
    uint8_t kinds;
} words_P[] PROGMEM = {
    { cmd_page, PAGE },     { cmd_copy, PAGE },   { cmd_save, PAGE },               { cmd_step, STEP7 },
    { cmd_go, STEP },       { cmd_write, STEP },  { cmd_insert, STEP },             { cmd_delete, STEP },
    { cmd_mirror, STEP },   { cmd_paste, STEP },  { cmd_move, WORDS(STEP7, STEP7) }, { cmd_swap, WORDS(STEP, STEP) },
    { cmd_int, WORDS(STEP, STEP) }, { cmd_take, WORDS(STEP, STEP) }, { cmd_scale, PERCENT }, { cmd_rows, ROWS },
    { cmd_goto, WORDS(X, Y) }, { cmd_play, PLAYED }, { cmd_check, PLAYED }, { cmd_list, WORDS(PAGE, PAGE) },
};

static uint8_t kinds_of(const shell_command_t *command_P)
{
    shell_handler_t handler = (shell_handler_t)pgm_read_ptr(&command_P->handler);
    for (uint8_t i = 0; i < ARRAY_COUNT(words_P); i++) {
        if ((shell_handler_t)pgm_read_ptr(&words_P[i].handler) == handler) {
            return pgm_read_byte(&words_P[i].kinds);
        }
    }
    return OWN;
}

bool commands_numbers(editor_t *editor)
{
    const shell_command_t *command_P = shell_find(commands_table_P, commands_count, &editor->args, 0);
    uint8_t kinds = command_P == NULL ? (uint8_t)OWN : kinds_of(command_P);
    for (uint8_t i = 0; i < ARRAY_COUNT(editor->number) && i + 1 < editor->args.count; i++, kinds >>= 4) {
        uint8_t kind = kinds & 15u;
        if (kind != OWN &&
            !shell_number(&editor->args, (uint8_t)(i + 1u), kinds_P[kind].name, pgm_read_word(&kinds_P[kind].min),
                          pgm_read_word(&kinds_P[kind].max), &editor->number[i])) {
            return false;
        }
    }
    return true;
}
