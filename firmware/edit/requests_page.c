/* SPDX-License-Identifier: MIT
 * requests_page.c - Edit's own requests, which load and save a page: @open, @data, @crc, @save; @play with the trim; and its
 * requests_image. */
#include <string.h>
#include "board.h"
#include "commands.h"
#include "pgm.h"
#include "ranges_own.h"
#include "requests.h"
#include "text.h"
#include "tick.h"

#define DATA_BYTES_MAX 32u

#define REQUEST(name) static uint8_t name(const shell_args_t *args)

REQUEST(do_open)
{
    /* The person's answer is about the page that is open. */
    if (the_dialog.mode == DIALOG_ASK || the_dialog.mode == DIALOG_NAME) {
        return requests_refuse(REQUEST_ERR_ASKED, TEXT_P("Edit waits for an answer on its terminal"));
    }
    if (the_session.is_changed) {
        return requests_refuse(REQUEST_ERR_UNSAVED, TEXT_P("The open page has unsaved edits"));
    }
    robot_open_page((uint8_t)args->number[0]);
    return REQUEST_OK;
}

/* Parses pairs of hexadecimal digits as bytes. Returns their number; 0: bad digits. */
static uint8_t parse_bytes(const char *hex, uint8_t to[DATA_BYTES_MAX])
{
    uint8_t count = 0;
    for (; *hex != '\0'; hex += 2, count++) {
        uint16_t byte;
        if (count == DATA_BYTES_MAX || !shell_hex(hex, 2, &byte)) {
            return 0;
        }
        to[count] = (uint8_t)byte;
    }
    return count;
}

REQUEST(do_data)
{
    uint8_t bytes[DATA_BYTES_MAX];
    const uint16_t offset = args->number[0];
    const uint8_t count = parse_bytes(shell_word(args, 2), bytes);
    if (count == 0 || offset + count > PAGE_BYTES) {
        return requests_refuse(REQUEST_ERR_RANGE,
                               TEXT_P("Data is 1..32 hex bytes, within the page"));
    }
    memcpy(&the_session.cells[offset], bytes, count);
    session_replaced();
    return REQUEST_OK;
}

REQUEST(do_crc)
{
    text_put(' ');
    text_hex(page_save_crc(the_session.cells), 4);
    return REQUEST_OK;
}

/* The CRC replaces a person's confirmation: it proves that the program means the page in RAM. */
REQUEST(do_save)
{
    uint16_t crc;
    if (!shell_parse(shell_word(args, 2), true, &crc)) {
        return requests_refuse(REQUEST_ERR_RANGE, TEXT_P("CRC must be hex"));
    }
    if (crc != page_save_crc(the_session.cells)) {
        return requests_refuse(REQUEST_ERR_CRC, TEXT_P("The CRC does not fit the page in RAM"));
    }
    const page_save_status_t status = cmd_page_save((uint8_t)args->number[0]);
    if (status > PAGE_SAVE_UNCHANGED) {
        return requests_refuse(REQUEST_ERR_SAVE, cmd_page_saved_P(status));
    }
    return REQUEST_OK;
}

REQUEST(do_play)
{
    const uint8_t result = request_play(args);
    if (result == REQUEST_OK) {
        robot_trim_play();
    }
    return result;
}

TEXT_NAMED(word_open, "open  ");
TEXT_NAMED(word_data, "data  ");
TEXT_NAMED(word_crc, "crc  ");
TEXT_NAMED(word_save, "save  ");
TEXT_NAMED(word_play, "play  ");
TEXT_NAMED(word_stop, "stop  ");
TEXT_NAMED(word_break, "break  ");
TEXT_NAMED(word_pause, "pause  ");
TEXT_NAMED(word_resume, "resume  ");
static const shell_command_t own[] PROGMEM = {
    { word_open, do_open, SHELL_ARGS(1, 1) | SHELL_STILL, RANGE_PAGE },
    { word_data, do_data, SHELL_ARGS(2, 2) | SHELL_STILL, RANGE_OFFSET },
    { word_crc, do_crc, SHELL_ARGS(0, 0), 0 },
    { word_save, do_save, SHELL_ARGS(2, 2) | SHELL_STILL, RANGE_PAGE },
    { word_play, do_play, SHELL_ARGS(1, 2), SHELL_BOTH(RANGE_PLAYED, RANGE_CODE) },
    { word_stop, request_stop, SHELL_ARGS(0, 0), 0 },
    { word_break, request_break, SHELL_ARGS(0, 0), 0 },
    { word_pause, request_pause, SHELL_ARGS(0, 0), 0 },
    { word_resume, request_resume, SHELL_ARGS(0, 0), 0 },
};

static const requests_table_t own_words = { own, ARRAY_COUNT(own) };

static void __attribute__((noreturn)) restart(void)
{
    board_restart(&the_settings_store);
}

static const char name[] PROGMEM = "edit";
TEXT_NAMED(can, ",open,data,save");
const requests_image_t requests_image = {
    .name_P = name, .can_P = can, .performer = &the_performer, .servos = &the_servos, .pages = &the_pages,
    .own = &own_words, .serve = robot_serve, .restart = restart,
};
