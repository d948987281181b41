/* SPDX-License-Identifier: MIT */
#include "machine.h"

#include <string.h>
#include "board.h"
#include "crc16.h"
#include "report.h"
#include "text.h"
#include "tick.h"

#define PROTOCOL_VERSION 1u
#define LINE_CHARACTERS 110u     /* the longest request, for @ver */
#define DATA_BYTES_MAX 32u
#define SPEED_MAX_DEG_S 360u
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

/* An answer is ` field=...` pieces and one of these two ends. A handler that fails prints nothing before its error. */
static void end_ok(void)
{
    TEXT(" OK");
}

static machine_status_t error(machine_status_t status)
{
    TEXT(" ERR ");
    text_number((uint16_t)status);
    text_put(' ');
    return status;
}

static machine_status_t range_error(const char *what_P, uint16_t min, uint16_t max)
{
    (void)error(MACHINE_ERR_RANGE);
    shell_print_range(what_P, min, max, false);
    return MACHINE_ERR_RANGE;
}

static machine_status_t image_error(void)
{
    (void)error(MACHINE_ERR_IMAGE);
    TEXT("Not in this image");
    return MACHINE_ERR_IMAGE;
}

static machine_status_t refusal(performer_status_t status, uint8_t page, uint8_t fault)
{
    static const uint8_t numbers[] PROGMEM = {
        [PERFORMER_OK] = MACHINE_OK,
        [PERFORMER_ERR_RANGE] = MACHINE_ERR_RANGE,
        [PERFORMER_ERR_PAGE] = MACHINE_ERR_PAGE,
        [PERFORMER_ERR_EMPTY] = MACHINE_ERR_EMPTY,
        [PERFORMER_ERR_BUSY] = MACHINE_ERR_BUSY,
        [PERFORMER_ERR_NO_SERVOS] = MACHINE_ERR_SERVOS,
        [PERFORMER_ERR_RELEASED] = MACHINE_ERR_RELEASED,
    };
    if (status == PERFORMER_OK) {
        end_ok();
        return MACHINE_OK;
    }
    const machine_status_t number = error((machine_status_t)pgm_read_byte(&numbers[status]));
    report_refusal(status, page, fault);
    return number;
}

/* Numbers in requests are decimal or 0x, whatever the mode of a person's numbers. */
static bool number(const shell_args_t *args, uint8_t index, uint16_t min, uint16_t max, uint16_t *value)
{
    uint16_t parsed;
    if (!shell_parse(shell_word(args, index), false, &parsed) || parsed < min || parsed > max) {
        return false;
    }
    *value = parsed;
    return true;
}

static void field(const char *name_P, uint16_t value)
{
    text_put(' ');
    text_P(name_P);
    text_put('=');
    text_number(value);
}

/* ---- what is there ---- */

static machine_status_t do_ver(machine_t *machine, const shell_args_t *args)
{
    app_record_t record;
    (void)args;
    TEXT(" image=");
    text_P(machine->image->name_P);
    if (board_record(&record)) {
        TEXT(" version=");
        text_number(record.version[0]);
        text_put('.');
        text_number(record.version[1]);
        text_put('.');
        text_number(record.version[2]);
        text_P(record.board == APP_RECORD_CM2 ? PSTR(" board=cm2") : PSTR(" board=cm5"));
    }
    field(PSTR("protocol"), PROTOCOL_VERSION);
    field(PSTR("pages"), PAGE_COUNT);
    field(PSTR("joints"), PAGE_JOINTS);
    field(PSTR("line"), LINE_CHARACTERS);
    TEXT(" can=list,page,pose,move,torque,play,pause,where");
    if (machine->image->ram_page != NULL) {
        TEXT(",open,save");
    }
    end_ok();
    return MACHINE_OK;
}

/* number:steps:"name", or number:!:"what is wrong". */
static void print_list_entry(const machine_t *machine, uint8_t page)
{
    uint8_t header[PAGE_AT_STEPS + 1];
    const bool good = page_store_is_good(machine->pages, page);
    page_store_read(page, 0, header, sizeof header);
    if (good ? header[PAGE_AT_NAME] == '\0' && header[PAGE_AT_STEPS] == 0 : page_store_is_erased(page)) {
        return;
    }
    text_put(' ');
    text_number(page);
    text_put(':');
    if (!good) {
        TEXT("!:\"");
        report_page_fault((uint8_t)page_store_check(machine->pages, page));
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

static machine_status_t do_list(machine_t *machine, const shell_args_t *args)
{
    uint16_t first = 0, last = PAGE_COUNT - 1;
    if (args->count == 2) {
        return range_error(PSTR("Last page"), 0, PAGE_COUNT - 1);
    }
    if (args->count == 3 &&
        (!number(args, 1, 0, PAGE_COUNT - 1, &first) || !number(args, 2, first, PAGE_COUNT - 1, &last))) {
        return range_error(PSTR("Page"), 0, PAGE_COUNT - 1);
    }
    for (uint8_t page = (uint8_t)first; page <= last; page++) {
        print_list_entry(machine, page);
    }
    end_ok();
    return MACHINE_OK;
}

static uint16_t print_hex_piece(uint16_t crc, const uint8_t *bytes, uint8_t count)
{
    for (uint8_t i = 0; i < count; i++) {
        text_hex(bytes[i], 2);
    }
    return crc16_bytes(crc, bytes, count);
}

static machine_status_t do_page(machine_t *machine, const shell_args_t *args)
{
    uint16_t page;
    (void)machine;
    if (!number(args, 1, 0, PAGE_COUNT - 1, &page)) {
        return range_error(PSTR("Page"), 0, PAGE_COUNT - 1);
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
    end_ok();
    return MACHINE_OK;
}

/* id:position:torque, position "?" when the servo does not answer. */
static machine_status_t do_pose(machine_t *machine, const shell_args_t *args)
{
    const servo_link_t *servos = machine->servos;
    (void)args;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        const uint32_t joint = SERVO_LINK_BIT(id);
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
    end_ok();
    return MACHINE_OK;
}

static void print_state_name(const performer_t *performer)
{
    static const char idle[] PROGMEM = "idle", ready[] PROGMEM = "ready", approach[] PROGMEM = "approach",
                      paused[] PROGMEM = "paused", playing[] PROGMEM = "playing";
    static const char *const names[] PROGMEM = {
        [PERFORMER_IDLE] = idle, [PERFORMER_READY] = ready, [PERFORMER_APPROACH] = approach,
        [PERFORMER_STOOD] = paused, [PERFORMER_PLAY] = playing,
    };
    text_P(performer_is_paused(performer) ? paused : (const char *)pgm_read_ptr(&names[performer->state]));
}

static machine_status_t do_where(machine_t *machine, const shell_args_t *args)
{
    const performer_t *performer = machine->performer;
    const bool plays = performer->state == PERFORMER_PLAY;
    (void)args;
    TEXT(" state=");
    print_state_name(performer);
    field(PSTR("page"), performer_is_idle(performer) ? 0 : performer->page);
    field(PSTR("step"), plays ? performer->engine.player.step : 0);
    field(PSTR("repetition"), plays ? performer->engine.player.repetition : 0);
    field(PSTR("code"), plays ? performer->link.code : 0);
    field(PSTR("dv"), machine->servos->voltage_dv);
    field(PSTR("missed"), tick_missed());
    TEXT(" faulty=");
    text_hex((uint16_t)(performer->faulty >> 16), 4);
    text_hex((uint16_t)performer->faulty, 4);
    end_ok();
    return MACHINE_OK;
}

/* ---- what moves ---- */

static machine_status_t id_error(void)
{
    return range_error(PSTR("ID"), 0, SERVO_LINK_JOINTS - 1);
}

/* Three hexadecimal digits for one joint. */
static bool hex_position(const char *digits, uint16_t *pos)
{
    char word[4];
    memcpy(word, digits, 3);
    word[3] = '\0';
    return (word[1] | 0x20) != 'x' && shell_parse(word, true, pos) && *pos <= PAGE_POS_MAX;
}

/* Fills to_pos and returns the joints that the digits name; 0: they are not as they must be. */
static uint32_t parse_pose(uint8_t id, const char *digits, uint16_t to_pos[PAGE_JOINTS])
{
    uint32_t joints = 0;
    if (strlen(digits) % 3 != 0) {
        return 0;
    }
    for (; *digits != '\0'; digits += 3, id++) {
        if (id >= PAGE_JOINTS) {
            return 0;
        }
        if (memcmp_P(digits, PSTR("---"), 3) == 0) {
            continue;
        }
        if (!hex_position(digits, &to_pos[id])) {
            return 0;
        }
        joints |= SERVO_LINK_BIT(id);
    }
    return joints;
}

static machine_status_t do_move(machine_t *machine, const shell_args_t *args)
{
    uint16_t to_pos[PAGE_JOINTS] = {0};
    uint16_t deg_s, id;
    if (!number(args, 1, 1, SPEED_MAX_DEG_S, &deg_s)) {
        return range_error(PSTR("Degrees/s"), 1, SPEED_MAX_DEG_S);
    }
    if (!number(args, 2, 0, PAGE_JOINTS - 1, &id)) {
        return id_error();
    }
    const uint32_t joints = parse_pose((uint8_t)id, shell_word(args, 3), to_pos);
    if (joints == 0) {
        (void)error(MACHINE_ERR_RANGE);
        TEXT("Positions must be 000..3FF or ---, up to ID 30");
        return MACHINE_ERR_RANGE;
    }
    return refusal(performer_move(machine->performer, to_pos, joints, deg_s), 0, 0);
}

/* One joint at a time, so that nothing else waits for longer than 3 ms. Returns those that are on. */
static uint32_t switch_on(machine_t *machine, uint32_t joints)
{
    uint32_t on = 0;
    for (uint8_t id = 0; id < SERVO_LINK_JOINTS; id++) {
        if ((joints & SERVO_LINK_BIT(id)) != 0) {
            on |= performer_on(machine->performer, SERVO_LINK_BIT(id));
            if (machine->image->service != NULL) {
                machine->image->service(machine->image->context);
            }
        }
    }
    return on;
}

static machine_status_t do_torque(machine_t *machine, const shell_args_t *args)
{
    const bool on = shell_word_is(args, 1, PSTR("on"));
    uint32_t joints = args->count == 2 ? machine->servos->present : 0;
    if (!on && !shell_word_is(args, 1, PSTR("off"))) {
        (void)error(MACHINE_ERR_RANGE);
        TEXT("Say on or off");
        return MACHINE_ERR_RANGE;
    }
    for (uint8_t i = 2; i < args->count; i++) {
        uint16_t id;
        if (!number(args, i, 0, PAGE_JOINTS - 1, &id)) {
            return id_error();
        }
        joints |= SERVO_LINK_BIT(id);
    }
    if (on && !performer_is_idle(machine->performer)) {
        return refusal(PERFORMER_ERR_BUSY, 0, 0);
    }
    if ((joints & machine->servos->present) != joints || joints == 0 ||
        (on && switch_on(machine, joints) != joints)) {
        (void)error(MACHINE_ERR_SERVOS);
        TEXT("Not all of these servos answer");
        return MACHINE_ERR_SERVOS;
    }
    if (!on) {
        performer_off(machine->performer, joints);
    }
    end_ok();
    return MACHINE_OK;
}

static machine_status_t do_play(machine_t *machine, const shell_args_t *args)
{
    uint16_t page, code = LINK_CODE_NONE;
    if (!number(args, 1, 1, PAGE_COUNT - 1, &page)) {
        return range_error(PSTR("Page"), 1, PAGE_COUNT - 1);
    }
    if (args->count == 3 && !number(args, 2, 0, LINK_CODE_STOP - 1, &code)) {
        return range_error(PSTR("Code"), 0, LINK_CODE_STOP - 1);
    }
    const performer_status_t status = performer_start(machine->performer, (uint8_t)page, (uint8_t)code);
    return refusal(status, (uint8_t)page, machine->performer->fault);
}

/* These four say OK also when there is nothing to do: a program asks @where. */
static machine_status_t do_stop(machine_t *machine, const shell_args_t *args)
{
    (void)args;
    performer_stop(machine->performer);
    end_ok();
    return MACHINE_OK;
}

static machine_status_t do_break(machine_t *machine, const shell_args_t *args)
{
    (void)args;
    performer_break(machine->performer);
    end_ok();
    return MACHINE_OK;
}

static machine_status_t do_pause(machine_t *machine, const shell_args_t *args)
{
    (void)args;
    (void)performer_pause(machine->performer);
    end_ok();
    return MACHINE_OK;
}

static machine_status_t do_resume(machine_t *machine, const shell_args_t *args)
{
    (void)args;
    (void)performer_resume(machine->performer);
    end_ok();
    return MACHINE_OK;
}

/* ---- a page in ---- */

static machine_status_t image_result(machine_status_t status)
{
    switch (status) {
    case MACHINE_OK:
        end_ok();
        break;
    case MACHINE_ERR_UNSAVED:
        (void)error(status);
        TEXT("The open page has edits that are not saved");
        break;
    case MACHINE_ERR_BUSY:
        (void)error(status);
        TEXT("Not while something plays");
        break;
    default:
        (void)error(status);
        TEXT("The page could not be saved");
        break;
    }
    return status;
}

static machine_status_t do_open(machine_t *machine, const shell_args_t *args)
{
    uint16_t page;
    if (machine->image->open == NULL) {
        return image_error();
    }
    if (!number(args, 1, 0, PAGE_COUNT - 1, &page)) {
        return range_error(PSTR("Page"), 0, PAGE_COUNT - 1);
    }
    return image_result(machine->image->open(machine->image->context, (uint8_t)page));
}

static bool hex_byte(const char *digits, uint8_t *byte)
{
    const char word[3] = {digits[0], digits[1], '\0'};
    uint16_t value;
    if (digits[1] == '\0' || word[1] == 'x' || word[1] == 'X' || !shell_parse(word, true, &value)) {
        return false;
    }
    *byte = (uint8_t)value;
    return true;
}

static machine_status_t do_data(machine_t *machine, const shell_args_t *args)
{
    uint16_t offset;
    uint8_t bytes[DATA_BYTES_MAX];
    const char *hex = shell_word(args, 2);
    const uint8_t count = (uint8_t)(strlen(hex) / 2);
    if (machine->image->ram_page == NULL) {
        return image_error();
    }
    if (!number(args, 1, 0, PAGE_BYTES - 1, &offset) || offset + count > PAGE_BYTES) {
        return range_error(PSTR("Offset and data"), 0, PAGE_BYTES - 1);
    }
    if (count > DATA_BYTES_MAX) {
        return range_error(PSTR("Bytes of data"), 1, DATA_BYTES_MAX);
    }
    for (uint8_t i = 0; hex[2 * i] != '\0'; i++) {
        if (!hex_byte(hex + 2 * i, &bytes[i])) {
            (void)error(MACHINE_ERR_RANGE);
            TEXT("Data must be pairs of hexadecimal digits");
            return MACHINE_ERR_RANGE;
        }
    }
    memcpy(machine->image->ram_page(machine->image->context) + offset, bytes, count);
    if (machine->image->changed != NULL) {
        machine->image->changed(machine->image->context);
    }
    end_ok();
    return MACHINE_OK;
}

static uint16_t ram_crc(const machine_t *machine)
{
    return crc16_bytes(CRC16_START, machine->image->ram_page(machine->image->context), PAGE_BYTES);
}

static machine_status_t do_crc(machine_t *machine, const shell_args_t *args)
{
    (void)args;
    if (machine->image->ram_page == NULL) {
        return image_error();
    }
    text_put(' ');
    text_hex(ram_crc(machine), 4);
    end_ok();
    return MACHINE_OK;
}

static machine_status_t do_save(machine_t *machine, const shell_args_t *args)
{
    uint16_t page, crc;
    if (machine->image->save == NULL || machine->image->ram_page == NULL) {
        return image_error();
    }
    if (!number(args, 1, 0, PAGE_COUNT - 1, &page)) {
        return range_error(PSTR("Page"), 0, PAGE_COUNT - 1);
    }
    if (!shell_parse(shell_word(args, 2), true, &crc) || crc != ram_crc(machine)) {
        (void)error(MACHINE_ERR_CRC);
        TEXT("The CRC does not fit the page in RAM");
        return MACHINE_ERR_CRC;
    }
    return image_result(machine->image->save(machine->image->context, (uint8_t)page));
}

/* ---- dispatch ---- */

typedef struct {
    char word[8];
    uint8_t args_min, args_max;
    machine_status_t (*handler)(machine_t *machine, const shell_args_t *args);
} command_t;

static const command_t table[] PROGMEM = {
    {"ver", 0, 0, do_ver},       {"list", 0, 2, do_list},     {"page", 1, 1, do_page},
    {"pose", 0, 0, do_pose},     {"move", 3, 3, do_move},    {"torque", 1, 32, do_torque},
    {"play", 1, 2, do_play},     {"stop", 0, 0, do_stop},     {"break", 0, 0, do_break},
    {"pause", 0, 0, do_pause},   {"resume", 0, 0, do_resume}, {"where", 0, 0, do_where},
    {"open", 1, 1, do_open},     {"data", 2, 2, do_data},     {"crc", 0, 0, do_crc},
    {"save", 2, 2, do_save},
};

static machine_status_t dispatch(machine_t *machine, const shell_args_t *args)
{
    const uint8_t given = (uint8_t)(args->count - 1);
    for (uint8_t i = 0; i < ARRAY_COUNT(table); i++) {
        command_t command;
        memcpy_P(&command, &table[i], sizeof command);
        if (strcasecmp(shell_word(args, 0) + 1, command.word) != 0) {
            continue;
        }
        if (given < command.args_min || given > command.args_max) {
            (void)error(MACHINE_ERR_COUNT);
            TEXT("Too few or too many words");
            return MACHINE_ERR_COUNT;
        }
        return command.handler(machine, args);
    }
    (void)error(MACHINE_ERR_WORD);
    TEXT("Unknown word");
    return MACHINE_ERR_WORD;
}

machine_status_t machine_run(machine_t *machine, const shell_args_t *args)
{
    text_string(shell_word(args, 0));
    const machine_status_t status = dispatch(machine, args);
    text_line_end();
    return status;
}
