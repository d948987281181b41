/* SPDX-License-Identifier: MIT
 * commands_layers.c - a second page over the play: for persons and programs. */
#include "commands_parts.h"

#include "performer_shape.h"
#include "pgm.h"
#include "text.h"

TEXT_NAMED(page_text, "Page");
static const commands_range_t page_range[] PROGMEM = { { page_text, 1, PAGE_COUNT - 1 } };

static uint8_t answer_of(const play_t *play, layers_status_t status)
{
    switch (status) {
    case LAYERS_OK:
        return REQUEST_OK;
    case LAYERS_ERR_PAGE:
    case LAYERS_ERR_EMPTY:
        (void)commands_error(play, status == LAYERS_ERR_PAGE ? REQUEST_ERR_PAGE : REQUEST_ERR_EMPTY);
        report_bad_page(play->performer.fault_page, play->performer.fault);
        return REQUEST_ERR_PAGE;
    case LAYERS_ERR_JOINTS:
        return commands_sentence(play, REQUEST_ERR_SERVOS, TEXT_P("None of these servos can be moved"));
    default:
        return commands_sentence(play, REQUEST_ERR_IDLE, TEXT_P("Nothing is playing"));
    }
}

uint8_t commands_do_layer(void *context, const shell_args_t *args)
{
    play_t *play = context;
    int16_t page;
    uint32_t joints = 0;
    if (args->count == 2 && shell_word_is(args, 1, PSTR("off"))) {
        performer_layer_off(&play->performer);
        return REQUEST_OK;
    }
    if (!commands_numbers(play, args, 1, page_range, 1, &page) ||
        (args->count > 2 && !commands_joints(play, args, 2, &joints))) {
        return REQUEST_ERR_RANGE;
    }
    return answer_of(play, performer_layer(&play->performer, (uint8_t)page, joints));
}
