/* SPDX-License-Identifier: MIT
 * cmd_list.c - HELP, LIST. Lists take the whole terminal: one item per line, one screen at a time. */
#include "commands.h"

#include "page_facts.h"
#include "pgm.h"
#include "report.h"
#include "text.h"

/* ---- HELP ---- */

/* The first lines of HELP, each terminated by a semicolon. */
TEXT_NAMED(first_wave,
           "A first wave:;"
           "page 99  opens an empty page;"
           "off      lets go: pose the robot by hand;"
           "on       it holds the pose;"
           "write    the pose becomes step 0. Again for the next: off, on, write;"
           "name hi;"
           "play     CR stops it, space breaks it off;"
           "save;"
           "Keys: arrows, Home End PgUp PgDn, [ ] -1 +1, { } -10 +10, space torque on/off;"
           "Commands:;");
enum { FIRST_LINES = 10 };

static void print_line_of(const char *lines_P, uint8_t line)
{
    text_reader_t reader;
    text_open_P(&reader, lines_P);
    for (char character; line > 0 || (character = text_next(&reader)) != ';';) {
        if (line == 0) {
            text_put(character);
        } else if (text_next(&reader) == ';') {
            line--;
        }
    }
    text_line_end();
}

static bool help_item(uint16_t item)
{
    if (item >= (uint16_t)(FIRST_LINES + commands_count)) {
        return false;
    }
    if (item < FIRST_LINES) {
        print_line_of(first_wave, (uint8_t)item);
    } else {
        shell_print_help(&commands_table_P[item - FIRST_LINES]);
    }
    return true;
}

COMMAND(cmd_help)
{
    if (args->count == 1) {
        return dialog_list(help_item, TEXT_P("Motion512"));
    }
    const shell_command_t *command = shell_find(commands_table_P, commands_count, args, 1);
    if (command == NULL) {
        return dialog_refuse(TEXT_P("No such command: HELP"));
    }
    shell_print_help(command);
    return SHELL_OK;
}

COMMAND(cmd_mon)
{
    return dialog_refuse(TEXT_P("MON and TOSS are in the image Monitor: load it"));
}

/* ---- LIST ---- */

static void print_time(uint32_t ticks)
{
    text_padded((uint16_t)(ticks / PLAYER_TICKS_PER_SECOND), 4, ' ');
    text_put('.');
    text_padded((uint16_t)((uint8_t)ticks % PLAYER_TICKS_PER_SECOND * 100u / PLAYER_TICKS_PER_SECOND), 2, '0');
    TEXT(" s");
}

static void print_page(uint8_t page)
{
    char name[PAGE_NAME_BYTES];
    page_store_name(page, name);
    text_padded(page, 3, ' ');
    TEXT("  ");
    text_string_padded(name, PAGE_NAME_BYTES);
    page_status_t status = page_store_check(&the_pages, page);
    if (status != PAGE_OK) {
        text_P(report_page_fault_P(status));
    } else {
        static const uint8_t fields[] PROGMEM = { PAGE_AT_STEPS, PAGE_AT_NEXT_PAGE, PAGE_AT_EXIT_PAGE,
            PAGE_AT_LINKED1_PAGE, PAGE_AT_LINKED1_CODE, PAGE_AT_LINKED2_PAGE, PAGE_AT_LINKED2_CODE, PAGE_AT_PLAY_CODE };
        for (uint8_t i = 0; i < sizeof fields; i++) {
            text_padded(page_store_byte(page, pgm_read_byte(&fields[i])), 4, ' ');
            text_put(' ');
        }
        print_time(page_facts_ticks(page));
    }
    text_line_end();
}

static bool list_page_item(uint16_t item)
{
    const uint16_t page = item + the_dialog.list_first;
    if (page > the_dialog.list_last) {
        return false;
    }
    if (!session_is_empty((uint8_t)page)) {
        print_page((uint8_t)page);
    }
    return true;
}

uint8_t cmd_refuse_backwards(void)
{
    return dialog_refuse(TEXT_P("Say the lower number first"));
}

COMMAND(cmd_list)
{
    the_dialog.list_first = (uint8_t)args->number[0];
    the_dialog.list_last = args->count > 2    ? (uint8_t)args->number[1]
                        : args->count == 2 ? (uint8_t)args->number[0]
                                           : PAGE_COUNT - 1u;
    if (the_dialog.list_last < the_dialog.list_first) {
        return cmd_refuse_backwards();
    }
    return dialog_list(list_page_item,
                       TEXT_P("Page name         steps next exit  lnk1 code lnk2 code call   time"));
}
