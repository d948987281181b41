/* SPDX-License-Identifier: MIT
 * board_api.h - the simulated robot as flat functions, for a web page: one CM-5 board with its servos (tools/sim).
 * Numbers only: no structs, no 64-bit integers. Bytes pass through one buffer. Everything declared here is exported by
 * board.wasm under its own name, and nothing else is (but `memory` and `_initialize`).
 *
 * One robot per module instance: load the module again for another one. Single-threaded. Time is counted in cycles of
 * 16 MHz from board_api_new() on, as a double (exact to 2^53 cycles: 17 years). The same seed, images and calls give
 * the same run, to the cycle, natively and in WebAssembly.
 *
 * Every function but board_api_buffer(), board_api_new() and the tables of names needs a board: without one it does
 * nothing and returns 0. Wrong numbers are clipped or refused, never undefined. */
#ifndef BOARD_API_H
#define BOARD_API_H

#include <stdbool.h>
#include <stdint.h>

#pragma GCC visibility push(default)

/* Bytes in and out: "count bytes" below stand at its beginning. */
#define BOARD_API_BUFFER_BYTES 0x80000 /* holds the largest Intel HEX file of 128 KiB */
uint8_t *board_api_buffer(void);

/* --- Life ------------------------------------------------------------------------------------------------------- */

/* Makes the board: no power, flash and EEPROM erased, no servos. kind: board_kind_t; seed: what the SRAM holds at
 * power-on. false: there is one already, or no memory. */
bool board_api_new(int kind, uint32_t seed);

/* Plugs in a servo. model: servo_model_t (0 AX-12), bps: its rate (1,000,000 for an AX-12). false: ID above 253, a 32nd
 * servo, or no memory. */
bool board_api_add_servo(int id, int model, uint32_t bps);

/* Power of board and servos. */
void board_api_power(bool on);
bool board_api_is_powered(void);

/* MODE is the reset pin: down holds the chip in reset. The others are button_t 0..4. */
void board_api_press(int button, bool down);

/* Battery voltage, clipped to 0..20. */
void board_api_battery(double volts);

/* --- Time ------------------------------------------------------------------------------------------------------- */

/* Runs to the first instruction boundary at or behind this moment. Returns board_stop_t: BOARD_STOP_TIME (0), or
 * BOARD_STOP_VIOLATION (1), after which the board stands still. */
int board_api_run(double until_cycle);
double board_api_now(void);
double board_api_busy(void); /* cycles in which the CPU executed instructions */
double board_api_resets(void);
int board_api_reset_cause(void);

/* What the firmware did that the chip does not allow: its kind (violation_kind_t, 0: nothing), the kind's name, and a
 * sentence with the address. Strings end in a NUL. */
int board_api_violation(void);
const char *board_api_violation_name(void);
const char *board_api_violation_text(void);

/* --- Memories --------------------------------------------------------------------------------------------------- */

/* Puts the Intel HEX text of `count` bytes in the buffer into flash; a boot loader also programs BOOTRST. Returns
 * image_status_t: 0 done; anything else and nothing was changed. */
int board_api_load_hex(uint32_t count);
const char *board_api_load_text(int status);

/* Direct access, as with a programmer, through the buffer; ranges are clipped and the bytes done returned. */
uint32_t board_api_flash_read(uint32_t address, uint32_t count);
uint32_t board_api_flash_write(uint32_t address, uint32_t count);
uint32_t board_api_eeprom_read(uint32_t address, uint32_t count);
uint32_t board_api_eeprom_write(uint32_t address, uint32_t count);

/* Flash and EEPROM writes by the firmware so far: when it has grown there is something to keep. */
double board_api_operations(void);

/* EEPROM of a servo (SERVO_EEPROM_BYTES, 24), by its index. Write before power-on. */
uint32_t board_api_servo_eeprom_read(int index);
bool board_api_servo_eeprom_write(int index);

/* --- Serial line and panel -------------------------------------------------------------------------------------- */

/* Queues `count` bytes of the buffer for the board. sender: console_sender_t, 0 the PC, 1 the remote. */
void board_api_send(int sender, uint32_t count);
uint32_t board_api_waiting(void); /* bytes still queued or on the line */
void board_api_drop_waiting(void);

/* Takes what the board has sent since the last call into the buffer; returns how many bytes. What does not fit into
 * the buffer stays for the next call. */
uint32_t board_api_receive(void);

/* Bit n: led_t n is lit. */
int board_api_leds(void);

/* --- Servos ----------------------------------------------------------------------------------------------------- */

int board_api_servos(void);

/* Brings all servos up to now and writes BOARD_API_SERVO_FIELDS doubles for each into a table, which is returned. */
enum {
    BOARD_API_SERVO_ID,
    BOARD_API_SERVO_GOAL,        /* servo units 0..1023 */
    BOARD_API_SERVO_POSITION,    /* servo units, with fractions */
    BOARD_API_SERVO_VELOCITY,    /* units a second */
    BOARD_API_SERVO_OUTPUT,      /* motor output, -1..1 */
    BOARD_API_SERVO_TORQUE,      /* torque enable, 0 or 1 */
    BOARD_API_SERVO_ALARMS,      /* SERVO_ERR_... bits */
    BOARD_API_SERVO_CELSIUS,
    BOARD_API_SERVO_FAULTS,      /* bit n: servo_fault_t n is on */
    BOARD_API_SERVO_LED,
    BOARD_API_SERVO_FIELDS
};
const double *board_api_servo_table(void);

/* A register of the control table, one or two bytes wide. */
int board_api_servo_register(int index, int address, int bytes);

/* A hand turns the horn to a position (servo units); a load pulls at it (-1..1 of stall torque). */
void board_api_servo_push(int index, double position);
void board_api_servo_load(int index, double load);

/* Hangs the servos' shafts on a body outside (servo_body.h), in lock step with the board; false: each turns its own rotor.
 * The module then calls its two imports, look and step of the module "body", with a pointer to the shafts (four doubles
 * each: ID, torque, angle, speed) and their number. Pushes and loads of single servos have no effect in a body. */
void board_api_body(bool attached);

/* Faults by number (servo_fault_t) and their names. answers: how many answers it spoils, 0 off, -1 until cleared. */
int board_api_faults(void);
const char *board_api_fault_name(int fault);
bool board_api_fault(int index, int fault, int answers);

#pragma GCC visibility pop

#endif
