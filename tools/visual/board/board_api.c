/* SPDX-License-Identifier: MIT */
#include "board_api.h"

#include <math.h>
#include <string.h>

#include "board.h"
#include "board_memory.h"
#include "board_ports.h"
#include "imported_body.h"
#include "intel_hex.h"
#include "servo_api.h"

#define SERVOS_MAX 31
#define FLASH_BYTES 0x20000u
#define BOOT_START 0x1E000u

static struct {
    board_t *board;
    size_t received; /* console bytes that the page has taken */
    double servos[SERVOS_MAX * BOARD_API_SERVO_FIELDS];
    uint8_t buffer[BOARD_API_BUFFER_BYTES];
} api;

static uint32_t clip(uint32_t count) { return count < sizeof api.buffer ? count : (uint32_t)sizeof api.buffer; }

static servo_bus_t *bus(void) { return board_servo_bus(api.board); }

/* The servo with this index, updated to now; NULL: none. */
static servo_t *servo_now(int index)
{
    servo_t *servo = api.board ? servo_api_at(bus(), index) : NULL;
    if (servo) {
        servo_advance(servo, board_now(api.board));
    }
    return servo;
}

uint8_t *board_api_buffer(void) { return api.buffer; }

bool board_api_new(int kind, uint32_t seed)
{
    if (api.board) {
        return false;
    }
    api.board = board_new(kind == BOARD_CM2 ? BOARD_CM2 : BOARD_CM5, seed);
    return api.board != NULL;
}

bool board_api_add_servo(int id, int model, uint32_t bps)
{
    if (!api.board || id < 0 || id >= SERVO_BROADCAST || bus()->count >= SERVOS_MAX || bps == 0) {
        return false;
    }
    return servo_bus_add(bus(), (uint8_t)id, model == SERVO_DX117 ? SERVO_DX117 : SERVO_AX12, bps) != NULL;
}

void board_api_power(bool on)
{
    if (api.board && on) {
        board_power_on(api.board);
    } else if (api.board) {
        board_power_off(api.board);
    }
}

bool board_api_is_powered(void) { return api.board && board_is_powered(api.board); }

void board_api_press(int button, bool down)
{
    if (!api.board || button < 0 || button >= BUTTON_COUNT) {
        return;
    }
    if (button == BUTTON_MODE) {
        board_hold_reset(api.board, down);
    } else {
        board_press(api.board, (button_t)button, down);
    }
}

void board_api_battery(double volts)
{
    if (api.board) {
        board_battery(api.board, fmin(fmax(volts, 0), 20));
    }
}

int board_api_run(double until_cycle)
{
    if (!api.board) {
        return BOARD_STOP_TIME;
    }
    double cycles = until_cycle - (double)board_now(api.board);
    return (int)board_run(api.board, cycles > 0 ? (uint64_t)cycles : 0);
}

double board_api_now(void) { return api.board ? (double)board_now(api.board) : 0; }

double board_api_busy(void) { return api.board ? (double)board_busy_cycles(api.board) : 0; }

double board_api_resets(void) { return api.board ? board_resets(api.board) : 0; }

int board_api_violation(void) { return api.board ? (int)board_violation(api.board)->kind : 0; }

const char *board_api_violation_name(void)
{
    return violation_name(api.board ? board_violation(api.board)->kind : VIOLATION_NONE);
}

const char *board_api_violation_text(void) { return api.board ? board_violation(api.board)->text : ""; }

static void write_used(const uint8_t *bytes, const bool *used)
{
    for (uint32_t at = 0; at < FLASH_BYTES; at++) {
        uint32_t from = at;
        while (at < FLASH_BYTES && used[at]) {
            at++;
        }
        if (at > from) {
            board_flash_write(api.board, from, bytes + from, at - from);
            if (at > BOOT_START) {
                board_set_bootrst(api.board, true);
            }
        }
    }
}

int board_api_load_hex(uint32_t count)
{
    static uint8_t bytes[FLASH_BYTES];
    static bool used[FLASH_BYTES];
    memset(used, 0, sizeof used);
    FILE *text = api.board && count ? fmemopen(api.buffer, clip(count), "r") : NULL;
    if (!text) {
        return IMAGE_NO_FILE;
    }
    image_status_t status = intel_hex_read(text, &(image_t){ bytes, used, sizeof bytes });
    fclose(text);
    if (status == IMAGE_OK) {
        write_used(bytes, used);
    }
    return (int)status;
}

const char *board_api_load_text(int status)
{
    return status >= IMAGE_OK && status <= IMAGE_NO_END ? image_text((image_status_t)status) : "?";
}

uint32_t board_api_flash_read(uint32_t address, uint32_t count)
{
    return api.board ? (uint32_t)board_flash_read(api.board, address, api.buffer, clip(count)) : 0;
}

uint32_t board_api_flash_write(uint32_t address, uint32_t count)
{
    return api.board ? (uint32_t)board_flash_write(api.board, address, api.buffer, clip(count)) : 0;
}

uint32_t board_api_eeprom_read(uint32_t address, uint32_t count)
{
    return api.board ? (uint32_t)board_eeprom_read(api.board, address, api.buffer, clip(count)) : 0;
}

uint32_t board_api_eeprom_write(uint32_t address, uint32_t count)
{
    return api.board ? (uint32_t)board_eeprom_write(api.board, address, api.buffer, clip(count)) : 0;
}

double board_api_operations(void) { return api.board ? (double)board_operations(api.board) : 0; }

uint32_t board_api_servo_eeprom_read(int index)
{
    const servo_t *servo = servo_now(index);
    if (!servo) {
        return 0;
    }
    memcpy(api.buffer, servo->table, SERVO_EEPROM_BYTES);
    return SERVO_EEPROM_BYTES;
}

bool board_api_servo_eeprom_write(int index)
{
    servo_t *servo = servo_now(index);
    if (servo) {
        memcpy(servo->table, api.buffer, SERVO_EEPROM_BYTES);
    }
    return servo != NULL;
}

void board_api_send(int sender, uint32_t count)
{
    if (api.board) {
        board_console_send(api.board, sender == CONSOLE_REMOTE ? CONSOLE_REMOTE : CONSOLE_PC, api.buffer, clip(count));
    }
}

uint32_t board_api_waiting(void) { return api.board ? (uint32_t)board_console_waiting(api.board) : 0; }

void board_api_drop_waiting(void)
{
    if (api.board) {
        board_console_flush(api.board);
    }
}

uint32_t board_api_receive(void)
{
    size_t count = 0;
    const uint8_t *output = api.board ? board_console_output(api.board, &count) : NULL;
    uint32_t taken = clip((uint32_t)(count - api.received));
    if (taken) {
        memcpy(api.buffer, output + api.received, taken);
    }
    api.received += taken;
    if (api.board && api.received == count) {
        board_console_forget(api.board);
        api.received = 0;
    }
    return taken;
}

int board_api_leds(void) { return api.board ? board_leds(api.board) : 0; }

int board_api_servos(void) { return api.board ? servo_api_count(bus()) : 0; }

static int faults_on(const servo_t *servo)
{
    int bits = 0;
    for (int fault = 0; fault < SERVO_FAULTS; fault++) {
        bits |= servo_fault_is_on(servo, (servo_fault_t)fault) << fault;
    }
    return bits;
}

const double *board_api_servo_table(void)
{
    for (int i = 0; i < board_api_servos() && i < SERVOS_MAX; i++) {
        const servo_t *servo = servo_now(i);
        double *row = api.servos + i * BOARD_API_SERVO_FIELDS;
        row[BOARD_API_SERVO_ID] = servo->table[SERVO_ID];
        row[BOARD_API_SERVO_GOAL] = servo_get(servo, SERVO_GOAL, 2);
        row[BOARD_API_SERVO_POSITION] = servo->position;
        row[BOARD_API_SERVO_VELOCITY] = servo->velocity;
        row[BOARD_API_SERVO_OUTPUT] = servo->output;
        row[BOARD_API_SERVO_TORQUE] = servo_get(servo, SERVO_TORQUE_ENABLE, 1);
        row[BOARD_API_SERVO_ALARMS] = servo->alarms;
        row[BOARD_API_SERVO_CELSIUS] = servo->temperature_c;
        row[BOARD_API_SERVO_FAULTS] = faults_on(servo);
        row[BOARD_API_SERVO_LED] = servo_get(servo, SERVO_LED, 1);
    }
    return api.servos;
}

int board_api_servo_register(int index, int address, int bytes)
{
    const servo_t *servo = servo_now(index);
    bool inside = address >= 0 && (bytes == 1 || bytes == 2) && address + bytes <= SERVO_TABLE_BYTES;
    return servo && inside ? servo_get(servo, (uint8_t)address, (uint8_t)bytes) : 0;
}

void board_api_servo_push(int index, double position)
{
    servo_t *servo = servo_now(index);
    if (servo) {
        servo_push_to(servo, board_now(api.board), position);
    }
}

void board_api_body(bool attached)
{
    if (api.board) {
        board_body(api.board, attached ? imported_body() : NULL);
    }
}

int board_api_faults(void) { return SERVO_FAULTS; }

const char *board_api_fault_name(int fault)
{
    return fault >= 0 && fault < SERVO_FAULTS ? servo_fault_name((servo_fault_t)fault) : "";
}

bool board_api_fault(int index, int fault, int answers)
{
    servo_t *servo = servo_now(index);
    if (!servo || fault < 0 || fault >= SERVO_FAULTS) {
        return false;
    }
    uint32_t count = answers < 0 ? SERVO_FAULT_ALWAYS : (uint32_t)answers;
    servo_bus_fault(bus(), board_now(api.board), servo, (servo_fault_t)fault, count);
    return true;
}
