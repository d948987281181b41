/* SPDX-License-Identifier: MIT
 * commands_play.c - play, stop, break, pause, resume, code. */
#include "commands_parts.h"

#include "text.h"
#include "views.h"

/* The page with this name; 0: none or several, and an error has been printed. */
static uint8_t page_of_name(const play_t *play, const shell_args_t *args)
{
    /* A name may hold separators: the words are put together again with a space between. */
    char name[PAGE_NAME_BYTES];
    uint8_t length = 0;
    for (uint8_t i = 1; i < args->count; i++) {
        for (const char *word = shell_word(args, i); *word != '\0' && length < sizeof name - 1; word++) {
            name[length++] = *word;
        }
        if (i + 1u < args->count && length < sizeof name - 1) {
            name[length++] = ' ';
        }
    }
    name[length] = '\0';
    const uint8_t page = page_store_find(&play->pages, name, 0);
    if (page == 0) {
        (void)requests_error(REQUEST_ERR_RANGE);
        TEXT("No page is named ");
        text_string(name);
    }
    return page;
}

/* Plays a page by its number, or by its name; a code may follow the number, as if from the remote. */
uint8_t commands_do_play(void *context, const shell_args_t *args)
{
    play_t *play = context;
    uint16_t page, code = LINK_CODE_NONE;
    const char first = shell_word(args, 1)[0];
    if (first >= '0' && first <= '9') {
        if (!shell_take(args, 1, RANGE_PLAYED, &page) || (args->count > 2 && !shell_take(args, 2, RANGE_CODE, &code))) {
            return SHELL_ERR_RANGE;
        }
    } else if ((page = page_of_name(play, args)) == 0) {
        return SHELL_ERR_REPORTED;
    }
    return requests_refusal(performer_start(&play->performer, (uint8_t)page, (uint8_t)code));
}

/* A person gets a refusal if there is nothing to do. A program gets OK and asks @where. */
static uint8_t done(bool something, const char *nothing_P)
{
    return something || requests_from_program() ? (uint8_t)REQUEST_OK : requests_refuse(REQUEST_ERR_IDLE, nothing_P);
}

/* NOINLINE: it would be copied twice. */
static NOINLINE uint8_t end(play_t *play, bool at_once)
{
    const bool moves = !performer_is_still(&play->performer);
    if (at_once) {
        performer_break(&play->performer);
    } else {
        performer_stop(&play->performer);
    }
    return done(moves, TEXT_P("Nothing is playing"));
}

uint8_t commands_do_stop(void *context, const shell_args_t *args)
{
    (void)args;
    return end(context, false);
}

uint8_t commands_do_break(void *context, const shell_args_t *args)
{
    (void)args;
    return end(context, true);
}

uint8_t commands_do_pause(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)args;
    return done(performer_pause(&play->performer), TEXT_P("Nothing to pause"));
}

uint8_t commands_do_resume(void *context, const shell_args_t *args)
{
    play_t *play = context;
    (void)args;
    return done(performer_resume(&play->performer), TEXT_P("Nothing is paused"));
}

/* Acts like the remote, for boards without a panel. */
uint8_t commands_do_code(void *context, const shell_args_t *args)
{
    play_t *play = context;
    inputs_refusal_t refusal;
    inputs_code(&play->inputs, (uint8_t)args->number[0]);
    if (!inputs_next_refusal(&play->inputs, &refusal)) {
        return REQUEST_OK;
    }
    views_print_refusal(&refusal);
    return SHELL_ERR_REPORTED;
}
