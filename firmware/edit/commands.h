/* SPDX-License-Identifier: MIT
 * commands.h - the words of the editor and their handlers. The table (commands.c) is in flash. A handler returns SHELL_OK,
 * SHELL_ERR_REPORTED, SHELL_ERR_RANGE or one of DIALOG_TO_... */
#ifndef COMMANDS_H
#define COMMANDS_H

#include <stdint.h>
#include "dialog.h"
#include "page_save.h"
#include "parts.h"
#include "robot.h"
#include "screen.h"
#include "session.h"

extern const shell_command_t commands_table_P[];
extern const uint8_t commands_count;

#define COMMAND(name) uint8_t name(const shell_args_t *args)

/* cmd_page.c */
COMMAND(cmd_page);
COMMAND(cmd_next);
COMMAND(cmd_before);
COMMAND(cmd_copy);
COMMAND(cmd_new);
COMMAND(cmd_save);
/* Saves the page in RAM as page `page`, for SAVE and @save; nothing else writes to flash. Sets its checksum byte, keeps the
 * servo bus quiet, and updates the store, the unsaved mark and the trim. 60 ms. */
page_save_status_t cmd_page_save(uint8_t page);
const char *cmd_page_saved_P(page_save_status_t status);   /* its result, for the user */
COMMAND(cmd_exit);
COMMAND(cmd_name);
COMMAND(cmd_undo);
COMMAND(cmd_redo);
/* Stores the name typed after "name:". */
void cmd_name_done(const char *name);

/* cmd_step.c */
COMMAND(cmd_step);
COMMAND(cmd_write);
COMMAND(cmd_insert);
COMMAND(cmd_delete);
COMMAND(cmd_move);
COMMAND(cmd_swap);
COMMAND(cmd_take);
COMMAND(cmd_paste);
/* Refuses, with a message, the step of page 0 that holds the trim, because it is computed and not a pose. */
bool cmd_step_is_trim(uint8_t step);

/* cmd_servo.c */
COMMAND(cmd_go);
COMMAND(cmd_mirror);
COMMAND(cmd_on);
COMMAND(cmd_off);
COMMAND(cmd_pairs);

/* cmd_cell.c */
COMMAND(cmd_set);
COMMAND(cmd_goto);
COMMAND(cmd_time);
COMMAND(cmd_speed);
COMMAND(cmd_hex);
COMMAND(cmd_dec);
COMMAND(cmd_re);
COMMAND(cmd_rows);
/* The keys [ ] { } (change by -1, 1, -10, 10) and space, on the cell under the cursor. */
void cmd_cell_change(int8_t change);
void cmd_cell_space(void);

/* cmd_play.c */
COMMAND(cmd_play);
void cmd_play_key(uint8_t key);
void cmd_play_events(bool line_is_free);
/* Shows faults on the row again if there are any and nothing is being typed. */
void cmd_play_tell_again(void);

/* cmd_list.c */
COMMAND(cmd_mon);
COMMAND(cmd_help);
COMMAND(cmd_list);
/* Refuses a range of pages or steps that ends before it begins. */
uint8_t cmd_refuse_backwards(void);

#endif
