/* SPDX-License-Identifier: MIT
 * cmd_list.c - HELP, LIST, FIND: what there is. Lists have the whole terminal, one item a line, a screen at a time. */
#include "commands.h"
#include "frame.h"
#include "page_facts.h"
#include "pgm.h"
#include "text.h"

/* ---- HELP ---- */

static bool help_item(uint8_t item)
{
    if (item >= commands_count) {
        return false;
    }
    shell_print_help(&commands_table_P[item]);
    return true;
}

COMMAND(cmd_help)
{
    if (args->count == 1) {
        return editor_list(help_item, TEXT_P("Keys: arrows, [ ] -1 +1, { } -10 +10, space"));
    }
    const shell_command_t *command = shell_find(commands_table_P, commands_count, args, 1);
    if (command == NULL) {
        TEXT("Bad Command");
        return SHELL_ERR_SAID;
    }
    shell_print_help(command);
    return SHELL_OK;
}

COMMAND(cmd_mon)
{
    (void)args;
    TEXT("MON and TOSS are an image of their own: load monitor.hex");
    return SHELL_ERR_SAID;
}

/* ---- LIST, FIND ---- */

static void print_time(uint16_t ticks)
{
    text_padded(ticks / PLAYER_TICKS_PER_SECOND, 4, ' ');
    text_put('.');
    text_padded((uint16_t)((ticks % PLAYER_TICKS_PER_SECOND) * 100u / PLAYER_TICKS_PER_SECOND), 2, '0');
    TEXT(" s");
}

static void print_page(uint8_t page)
{
    char name[PAGE_NAME_BYTES];
    uint8_t header[PAGE_STEP_BYTES];
    page_store_read(page, 0, header, sizeof header);
    page_store_name(page, name);
    text_padded(page, 3, ' ');
    TEXT("  ");
    text_string_padded(name, PAGE_NAME_BYTES);
    page_status_t status = page_store_check(&the_pages, page);
    if (status != PAGE_OK) {
        char text[FRAME_FAULT_BYTES];
        frame_fault_text(status == PAGE_ERR_STEPS ? header[PAGE_AT_STEPS] : (uint8_t)status, text);
        text_string(text);
    } else {
        static const uint8_t fields[] PROGMEM = { PAGE_AT_STEPS, PAGE_AT_NEXT_PAGE, PAGE_AT_EXIT_PAGE,
            PAGE_AT_LINKED1_PAGE, PAGE_AT_LINKED1_CODE, PAGE_AT_LINKED2_PAGE, PAGE_AT_LINKED2_CODE, PAGE_AT_PLAY_CODE };
        for (uint8_t i = 0; i < sizeof fields; i++) {
            text_padded(header[pgm_read_byte(&fields[i])], 4, ' ');
            text_put(' ');
        }
        print_time(page_facts_ticks(page));
    }
    text_line_end();
}

TEXT_NAMED(list_title, "Page name         steps next exit  lnk1 code lnk2 code call   time");

static bool list_page_item(uint8_t item)
{
    uint8_t page = (uint8_t)(item + the_editor.list_first);
    if (page > the_editor.list_last) {
        return false;
    }
    if (!session_is_empty(page)) {
        print_page(page);
    }
    return true;
}

COMMAND(cmd_list)
{
    the_editor.list_first = args->count > 1 ? (uint8_t)args->number[0] : 0;
    the_editor.list_last = args->count > 2    ? (uint8_t)args->number[1]
                        : args->count == 2 ? (uint8_t)args->number[0]
                                           : (uint8_t)(PAGE_COUNT - 1u);
    return editor_list(list_page_item, list_title);
}

static char lower(char character)
{
    return character >= 'A' && character <= 'Z' ? (char)(character - 'A' + 'a') : character;
}

static bool contains(const char *name, const char *part)
{
    for (; *name != '\0'; name++) {
        uint8_t i = 0;
        while (part[i] != '\0' && lower(name[i]) == lower(part[i])) {
            i++;
        }
        if (part[i] == '\0') {
            return true;
        }
    }
    return false;
}

static bool find_item(uint8_t item)
{
    char name[PAGE_NAME_BYTES];
    if (item >= PAGE_COUNT) {
        return false;
    }
    page_store_name(item, name);
    if (!page_store_is_erased(item) && contains(name, shell_word(&the_editor.args, 1))) {
        print_page(item);
    }
    return true;
}

COMMAND(cmd_find)
{
    (void)args;
    return editor_list(find_item, list_title);
}
