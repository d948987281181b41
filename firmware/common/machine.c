/* SPDX-License-Identifier: MIT */
#include "machine_parts.h"

#include <string.h>
#include "board.h"
#include "bound.h"
#include "crc16.h"
#include "report.h"
#include "text.h"
#include "tick.h"

#define CHUNK_BYTES 32u          /* a page is read in pieces of this size */

void machine_init(machine_t *machine, performer_t *performer, servo_link_t *servos, page_store_t *pages,
                  const machine_image_t *image)
{
    machine->performer = performer;
    machine->servos = servos;
    machine->pages = pages;
    machine->image = image;
}

bool machine_is_for(const shell_args_t *args)
{
    return shell_word(args, 0)[0] == '@';
}

/* ---- answers ---- */

uint8_t machine_error(uint8_t status)
{
    TEXT(" ERR ");
    text_number(status);
    text_put(' ');
    return status;
}

uint8_t machine_says(uint8_t status, const char *sentence_P)
{
    (void)machine_error(status);
    text_P(sentence_P);
    return status;
}

void machine_range_error(const char *what_P, uint16_t min, uint16_t max)
{
    (void)machine_error(MACHINE_ERR_RANGE);
    shell_print_range(what_P, min, max, false);
}

uint8_t machine_refusal(performer_status_t status, uint8_t page, uint8_t fault)
{
    static const uint8_t numbers[] PROGMEM = {
        [PERFORMER_OK] = MACHINE_OK,
        [PERFORMER_ERR_RANGE] = MACHINE_ERR_RANGE,
        [PERFORMER_ERR_PAGE] = MACHINE_ERR_PAGE,
        [PERFORMER_ERR_EMPTY] = MACHINE_ERR_EMPTY,
        [PERFORMER_ERR_BUSY] = MACHINE_ERR_BUSY,
        [PERFORMER_ERR_NO_SERVOS] = MACHINE_ERR_SERVOS,
        [PERFORMER_ERR_RELEASED] = MACHINE_ERR_RELEASED,
        [PERFORMER_ERR_LAW] = MACHINE_ERR_IMAGE,
    };
    if (status == PERFORMER_OK) {
        return MACHINE_OK;
    }
    const uint8_t number = machine_error(pgm_read_byte(&numbers[status]));
    report_refusal(status, page, fault);
    return number;
}

bool machine_number(const shell_args_t *args, uint8_t index, const char *what_P, uint16_t min, uint16_t max,
                    uint16_t *value)
{
    if (shell_parse(shell_word(args, index), false, value) && *value >= min && *value <= max) {
        return true;
    }
    machine_range_error(what_P, min, max);
    return false;
}

bool machine_page_number(const shell_args_t *args, uint8_t index, uint16_t min, uint16_t *page)
{
    return machine_number(args, index, TEXT_P("Page"), min, PAGE_COUNT - 1, page);
}

static void field(const char *name_P, uint16_t value)
{
    text_put(' ');
    text_P(name_P);
    text_put('=');
    text_number(value);
}

void machine_serve(const machine_t *machine)
{
    if (MACHINE_IMAGE(machine)->service != NULL) {
        MACHINE_IMAGE(machine)->service(MACHINE_IMAGE(machine)->context);
    }
}

/* ---- what is there ---- */

static uint8_t do_ver(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    app_record_t record;
    (void)args;
    TEXT(" image=");
    text_P(MACHINE_IMAGE(machine)->name_P);
    if (board_record(&record)) {
        TEXT(" version=");
        text_number(record.version[0]);
        text_put('.');
        text_number(record.version[1]);
        text_put('.');
        text_number(record.version[2]);
        text_P(record.board == APP_RECORD_CM2 ? TEXT_P(" board=cm2") : TEXT_P(" board=cm5"));
    }
    TEXT(" protocol=1 pages=128 joints=31 line=110");
    STATIC_ASSERT(PAGE_COUNT == 128 && PAGE_JOINTS == 31, "said in the line above");
    TEXT(" can=list,page,pose,move,torque,play,pause,where");
    if (MACHINE_IMAGE(machine)->ram_page != NULL) {
        TEXT(",open,save");
    }
    if (MACHINE_IMAGE(machine)->more != NULL) {
        TEXT(",shape");
    }
    return MACHINE_OK;
}

/* number:steps:"name", or number:!:"what is wrong". */
static void print_list_entry(const machine_t *machine, uint8_t page)
{
    uint8_t header[PAGE_AT_STEPS + 1];
    const bool good = page_store_is_good(MACHINE_PAGES(machine), page);
    page_store_read(page, 0, header, sizeof header);
    if (good ? header[PAGE_AT_NAME] == '\0' && header[PAGE_AT_STEPS] == 0 : page_store_is_erased(page)) {
        return;
    }
    text_put(' ');
    text_number(page);
    text_put(':');
    if (!good) {
        TEXT("!:\"");
        report_page_fault((uint8_t)page_store_check(MACHINE_PAGES(machine), page));
        text_put('"');
        return;
    }
    text_number(header[PAGE_AT_STEPS]);
    char name[PAGE_NAME_BYTES];
    page_store_name(page, name);
    TEXT(":\"");
    for (const char *c = name; *c != '\0'; c++) {
        text_put(*c == '"' ? '\'' : *c);
    }
    text_put('"');
}

static uint8_t do_list(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    uint16_t first = 0, last = PAGE_COUNT - 1;
    if (args->count > 1 && (!machine_page_number(args, 1, 0, &first) || !machine_page_number(args, 2, first, &last))) {
        return MACHINE_ERR_RANGE;
    }
    for (uint8_t page = (uint8_t)first; page <= last; page++) {
        print_list_entry(machine, page);
        machine_serve(machine); /* pages without an entry take up to 2 ms each */
    }
    return MACHINE_OK;
}

static uint16_t print_hex_piece(uint16_t crc, const uint8_t *bytes, uint8_t count)
{
    for (uint8_t i = 0; i < count; i++) {
        text_hex(bytes[i], 2);
    }
    return crc16_bytes(crc, bytes, count);
}

static uint8_t do_page(void *context, const shell_args_t *args)
{
    uint16_t page;
    (void)context;
    if (!machine_page_number(args, 1, 0, &page)) {
        return MACHINE_ERR_RANGE;
    }
    text_put(' ');
    text_number(page);
    text_put(' ');
    uint16_t crc = CRC16_START;
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset = (uint16_t)(offset + CHUNK_BYTES)) {
        uint8_t bytes[CHUNK_BYTES];
        page_store_read((uint8_t)page, offset, bytes, sizeof bytes);
        crc = print_hex_piece(crc, bytes, sizeof bytes);
    }
    text_put(' ');
    text_hex(crc, 4);
    return MACHINE_OK;
}

/* id:position:torque, position "?" when the servo does not answer. */
static uint8_t do_pose(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    const servo_link_t *servos = MACHINE_SERVOS(machine);
    (void)args;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        const uint32_t joint = servo_link_bit(id);
        if ((servos->present & joint) == 0) {
            continue;
        }
        text_put(' ');
        text_number(id);
        text_put(':');
        if ((servos->silent & joint) != 0 || servos->present_pos[id] == SERVO_LINK_NO_POSE) {
            text_put('?');
        } else {
            text_number(servos->present_pos[id]);
        }
        text_put(':');
        text_put((servos->torque & joint) != 0 ? '1' : '0');
    }
    return MACHINE_OK;
}

static void print_state_name(const performer_t *performer)
{
    TEXT_NAMED(idle, "idle");
    TEXT_NAMED(ready, "ready");
    TEXT_NAMED(approach, "approach");
    TEXT_NAMED(paused, "paused");
    TEXT_NAMED(playing, "playing");
    static const char *const names[] PROGMEM = {
        [PERFORMER_IDLE] = idle, [PERFORMER_READY] = ready, [PERFORMER_APPROACH] = approach,
        [PERFORMER_STOOD] = paused, [PERFORMER_PLAY] = playing,
    };
    text_P(performer_is_paused(performer) ? paused : (const char *)pgm_read_ptr(&names[performer->state]));
}

static uint8_t do_where(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    const performer_t *performer = MACHINE_PERFORMER(machine);
    const bool plays = performer->state == PERFORMER_PLAY;
    (void)args;
    TEXT(" state=");
    print_state_name(performer);
    field(TEXT_P("page"), performer_is_idle(performer) ? 0 : performer->page);
    field(TEXT_P("step"), plays ? performer->engine.player.step : 0);
    field(TEXT_P("repetition"), plays ? performer->engine.player.repetition : 0);
    field(TEXT_P("code"), plays ? performer->link.code : 0);
    field(TEXT_P("dv"), MACHINE_SERVOS(machine)->voltage_dv);
    field(TEXT_P("missed"), tick_missed());
    TEXT(" faulty=");
    text_hex((uint16_t)(performer->faulty >> 16), 4);
    text_hex((uint16_t)performer->faulty, 4);
    if (MACHINE_IMAGE(machine)->where != NULL) {
        MACHINE_IMAGE(machine)->where(MACHINE_IMAGE(machine)->context);
    }
    return MACHINE_OK;
}

/* Into the boot loader's hands: it listens for '#' for 60 ms before it starts an image again. */
static uint8_t do_reset(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    (void)args;
    if (!performer_is_still(MACHINE_PERFORMER(machine))) {
        return machine_refusal(PERFORMER_ERR_BUSY, 0, 0);
    }
    MACHINE_IMAGE(machine)->restart(MACHINE_IMAGE(machine)->context);
    return MACHINE_OK;
}

/* ---- dispatch ---- */

TEXT_NAMED(word_ver, "@ver  ");
TEXT_NAMED(word_list, "@list  ");
TEXT_NAMED(word_page, "@page  ");
TEXT_NAMED(word_pose, "@pose  ");
TEXT_NAMED(word_move, "@move  ");
TEXT_NAMED(word_torque, "@torque  ");
TEXT_NAMED(word_play, "@play  ");
TEXT_NAMED(word_stop, "@stop  ");
TEXT_NAMED(word_break, "@break  ");
TEXT_NAMED(word_pause, "@pause  ");
TEXT_NAMED(word_resume, "@resume  ");
TEXT_NAMED(word_where, "@where  ");
TEXT_NAMED(word_open, "@open  ");
TEXT_NAMED(word_data, "@data  ");
TEXT_NAMED(word_crc, "@crc  ");
TEXT_NAMED(word_save, "@save  ");
TEXT_NAMED(word_reset, "@reset  ");

static const shell_command_t table[] PROGMEM = {
    {word_ver, do_ver, SHELL_ARGS(0, 0), 0},
    {word_list, do_list, SHELL_ARGS(0, 2), 0},
    {word_page, do_page, SHELL_ARGS(1, 1), 0},
    {word_pose, do_pose, SHELL_ARGS(0, 0), 0},
    {word_move, machine_do_move, SHELL_ARGS(3, 3), 0},
    {word_torque, machine_do_torque, SHELL_ARGS(1, SHELL_ANY_ARGS), 0},
    {word_play, machine_do_play, SHELL_ARGS(1, 2), 0},
    {word_stop, machine_do_stop, SHELL_ARGS(0, 0), 0},
    {word_break, machine_do_break, SHELL_ARGS(0, 0), 0},
    {word_pause, machine_do_pause, SHELL_ARGS(0, 0), 0},
    {word_resume, machine_do_resume, SHELL_ARGS(0, 0), 0},
    {word_where, do_where, SHELL_ARGS(0, 0), 0},
    {word_open, machine_do_open, SHELL_ARGS(1, 1), 0},
    {word_data, machine_do_data, SHELL_ARGS(2, 2), 0},
    {word_crc, machine_do_crc, SHELL_ARGS(0, 0), 0},
    {word_save, machine_do_save, SHELL_ARGS(2, 2), 0},
    {word_reset, do_reset, SHELL_ARGS(0, 0), 0},
};

static uint8_t dispatch(machine_t *machine, const shell_args_t *args)
{
    uint8_t status = shell_run(table, ARRAY_COUNT(table), machine, args);
    if (status == SHELL_ERR_UNKNOWN && MACHINE_IMAGE(machine)->more != NULL) {
        status = MACHINE_IMAGE(machine)->more(MACHINE_IMAGE(machine)->context, args);
    }
    return status == SHELL_ERR_COUNT     ? machine_says(MACHINE_ERR_COUNT, TEXT_P("Too few or too many words"))
           : status == SHELL_ERR_UNKNOWN ? machine_says(MACHINE_ERR_WORD, TEXT_P("Unknown word"))
                                         : status;
}

machine_status_t machine_run(machine_t *machine, const shell_args_t *args)
{
    text_string(shell_word(args, 0));
    const uint8_t status = dispatch(machine, args);
    if (status == MACHINE_OK) {
        TEXT(" OK");
    }
    text_line_end();
    return (machine_status_t)status;
}
