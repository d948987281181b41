/* SPDX-License-Identifier: MIT
 * editor_line.c - runs a complete line, again after each answered question, and prints refusals. */
#include "commands.h"
#include "dialog.h"
#include "editor_parts.h"
#include "parts.h"
#include "requests.h"
#include "screen.h"
#include "session.h"
#include "text.h"

enum { MESSAGE_COLUMN_MAX = 40 };   /* behind a longer line a message would be cut */

static void print_refusal(uint8_t result)
{
    switch (result) {
    case SHELL_ERR_MOVING:
        TEXT("Something moves");
        break;
    case SHELL_ERR_RANGE:
        shell_print_range_error();
        break;
    case SHELL_ERR_UNKNOWN:
        TEXT("Bad Command");
        break;
    case SHELL_ERR_COUNT:
        TEXT("Invalid Parameter");
        break;
    default:
        break;
    }
}

static void go_on(uint8_t result)
{
    STATIC_ASSERT((int)DIALOG_ASK > (int)SHELL_ERR_REPORTED, "what a handler returns is a mode");
    if (result >= DIALOG_ASK && result <= DIALOG_PLAY) {
        the_dialog.mode = result;
        if (result == DIALOG_NAME) {
            shell_clear(&the_dialog.shell);
            the_screen.lead = false;
        }
        return;
    }
    print_refusal(result);
    dialog_end_line();
}

void editor_run(void)
{
    the_dialog.asked = 0;
    the_dialog.broken_off = the_dialog.faults_stand = false;
    the_screen.lead = true;
    the_screen.cramped = the_screen.line_column > MESSAGE_COLUMN_MAX;
    the_session.spare = performer_spare(&the_performer);
    go_on(shell_run(commands_table_P, commands_count, NULL, &the_dialog.args, !performer_is_idle(&the_performer)));
    the_session.spare = NULL;
}

void editor_line(void)
{
    if (the_dialog.mode == DIALOG_NAME) {
        cmd_name_done(the_dialog.line);
        dialog_end_line();
        return;
    }
    shell_split(&the_dialog.shell, the_session.hex, &the_dialog.args);
    editor_run();
}

void editor_program_line(void)
{
    the_screen.sink = SCREEN_PLAIN;
    shell_split(&the_dialog.shell, false, &the_dialog.args);
    requests_run(&the_dialog.args);
}
