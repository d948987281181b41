/* SPDX-License-Identifier: MIT
 * commands_play.c - words that begin, end and interrupt a play. */
#include "commands_parts.h"

#include "text.h"
#include "views.h"

/* The page that a word names, by number or by name; 0: there is none, and it has been said. */
static uint8_t page_of_word(const play_t *play, const shell_args_t *args)
{
    uint16_t number;
    const char *word = shell_word(args, 1);
    if (word[0] >= '0' && word[0] <= '9') {
        return shell_number(args, 1, TEXT_P("Page"), 1, PAGE_COUNT - 1, &number) ? (uint8_t)number : 0;
    }
    /* A name may hold separators: the words are put together again with a space between. */
    char name[PAGE_NAME_BYTES];
    uint8_t length = 0;
    for (uint8_t i = 1; i < args->count; i++) {
        for (word = shell_word(args, i); *word != '\0' && length < sizeof name - 1; word++) {
            name[length++] = *word;
        }
        if (i + 1u < args->count && length < sizeof name - 1) {
            name[length++] = ' ';
        }
    }
    name[length] = '\0';
    const uint8_t page = page_store_find(&play->pages, name, 0);
    if (page == 0) {
        TEXT("No page is named ");
        text_string(name);
    }
    return page;
}

uint8_t commands_do_play(void *context, const shell_args_t *args)
{
    play_t *play = context;
    const uint8_t page = page_of_word(play, args);
    if (page == 0) {
        return SHELL_ERR_SAID;
    }
    const performer_status_t status = performer_start(&play->performer, page, LINK_CODE_NONE);
    return commands_refuse(status, play->performer.fault_page, play->performer.fault);
}

static uint8_t nothing_is_playing(void)
{
    TEXT("Nothing is playing");
    return SHELL_ERR_SAID;
}

uint8_t commands_do_stop(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)args;
    if (performer_is_still(&play->performer)) {
        return nothing_is_playing();
    }
    performer_stop(&play->performer);
    return SHELL_OK;
}

uint8_t commands_do_break(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)args;
    if (performer_is_still(&play->performer)) {
        return nothing_is_playing();
    }
    performer_break(&play->performer);
    return SHELL_OK;
}

uint8_t commands_do_pause(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)args;
    if (performer_is_idle(&play->performer)) {
        return nothing_is_playing();
    }
    if (!performer_pause(&play->performer)) {
        TEXT("Cannot pause now");
        return SHELL_ERR_SAID;
    }
    return SHELL_OK;
}

uint8_t commands_do_resume(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)args;
    if (!performer_resume(&play->performer)) {
        TEXT("Nothing is paused");
        return SHELL_ERR_SAID;
    }
    return SHELL_OK;
}

/* The same as the remote: for boards without a panel. */
uint8_t commands_do_code(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint16_t code;
    inputs_refusal_t refusal;
    if (!shell_number(args, 1, TEXT_P("Code"), 0, 255, &code)) {
        return SHELL_ERR_SAID;
    }
    inputs_code(&play->inputs, (uint8_t)code);
    if (!inputs_next_refusal(&play->inputs, &refusal)) {
        return SHELL_OK;
    }
    views_print_refusal(&refusal);
    return SHELL_ERR_SAID;
}
