/* SPDX-License-Identifier: MIT
 * board_api.h - the simulated robot as flat functions for a web page: one CM-5 board with its servos (tools/sim).
 * Numbers only: no structs, no 64-bit integers. Bytes pass through one buffer. board.wasm exports everything declared
 * here under its own name, and otherwise only `memory` and `_initialize`.
 *
 * One robot per module instance; load the module again for another one. Single-threaded. Time is counted in cycles of
 * 16 MHz since board_api_new(), as a double (exact to 2^53 cycles: 17 years). The same seed, images and calls give the
 * same run, to the cycle, natively and in WebAssembly.
 *
 * Every function except board_api_buffer(), board_api_new() and the tables of names needs a board. Without one it does
 * nothing and returns 0. Wrong numbers are clipped or refused, never undefined. */
#ifndef BOARD_API_H
#define BOARD_API_H

#include <stdbool.h>
#include <stdint.h>

#pragma GCC visibility push(default)

/* Buffer for bytes in and out. "count bytes" below are at its start. */
#define BOARD_API_BUFFER_BYTES 0x80000 /* holds the largest Intel HEX file of 128 KiB */
uint8_t *board_api_buffer(void);

/* --- Life ------------------------------------------------------------------------------------------------------- */

/* Makes the board without power or servos, with flash and EEPROM erased. kind: board_kind_t; seed: determines the SRAM
 * contents at power-on. false: there is already a board, or no memory. */
bool board_api_new(int kind, uint32_t seed);

/* Plugs in a servo. model: servo_model_t (0 AX-12), bps: its rate (1,000,000 for an AX-12). false: ID above 253, a 32nd
 * servo, or no memory. */
bool board_api_add_servo(int id, int model, uint32_t bps);

/* Power of board and servos. */
void board_api_power(bool on);
bool board_api_is_powered(void);

/* MODE is the reset pin: down holds the chip in reset. The other buttons are button_t 0..4. */
void board_api_press(int button, bool down);

/* Battery voltage, clipped to 0..20. */
void board_api_battery(double volts);

/* --- Time ------------------------------------------------------------------------------------------------------- */

/* Runs to the first instruction boundary at or after this time. Returns board_stop_t: BOARD_STOP_TIME (0) or
 * BOARD_STOP_VIOLATION (1). After a violation the board does not run any more. */
int board_api_run(double until_cycle);
double board_api_now(void);
double board_api_busy(void); /* cycles in which the CPU executed instructions */
double board_api_resets(void);

/* A firmware action that the chip does not allow: its kind (violation_kind_t, 0: none), the kind's name, and a sentence
 * with the address. Strings end with a NUL. */
int board_api_violation(void);
const char *board_api_violation_name(void);
const char *board_api_violation_text(void);

/* --- Memories --------------------------------------------------------------------------------------------------- */

/* Loads the Intel HEX text of `count` bytes in the buffer into flash. A boot loader also programs BOOTRST. Returns
 * image_status_t: 0 done; otherwise nothing was changed. */
int board_api_load_hex(uint32_t count);
const char *board_api_load_text(int status);

/* Direct access through the buffer, as with a programmer. Ranges are clipped. Returns the number of bytes done. */
uint32_t board_api_flash_read(uint32_t address, uint32_t count);
uint32_t board_api_flash_write(uint32_t address, uint32_t count);
uint32_t board_api_eeprom_read(uint32_t address, uint32_t count);
uint32_t board_api_eeprom_write(uint32_t address, uint32_t count);

/* Flash and EEPROM writes by the firmware so far. If it has grown, there is something to store. */
double board_api_operations(void);

/* EEPROM of a servo (SERVO_EEPROM_BYTES, 24) by index. Write before power-on. */
uint32_t board_api_servo_eeprom_read(int index);
bool board_api_servo_eeprom_write(int index);

/* --- Serial line and panel -------------------------------------------------------------------------------------- */

/* Queues `count` bytes of the buffer for the board. sender: console_sender_t, 0 the PC, 1 the remote. */
void board_api_send(int sender, uint32_t count);
uint32_t board_api_waiting(void); /* bytes still queued or on the line */
void board_api_drop_waiting(void);

/* Moves what the board has sent since the last call into the buffer and returns the number of bytes. What does not fit
 * stays for the next call. */
uint32_t board_api_receive(void);

/* Bit n: led_t n is lit. */
int board_api_leds(void);

/* --- Servos ----------------------------------------------------------------------------------------------------- */

int board_api_servos(void);

/* Updates all servos to now and returns a table with BOARD_API_SERVO_FIELDS doubles for each. */
enum {
    BOARD_API_SERVO_ID,
    BOARD_API_SERVO_GOAL,        /* servo units 0..1023 */
    BOARD_API_SERVO_POSITION,    /* servo units, with fractions */
    BOARD_API_SERVO_VELOCITY,    /* units per second */
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

/* push turns the horn by hand to a position (servo units). */
void board_api_servo_push(int index, double position);

/* Connects the servos' shafts to an external body (servo_body.h) in lockstep with the board. false: each servo turns
 * its own rotor. The module calls its two imports, look and step of the module "body", with a pointer to the shafts
 * (four doubles each: ID, torque, angle, speed) and their number. With a body, pushes of single servos have no
 * effect. */
void board_api_body(bool attached);

/* Faults by number (servo_fault_t) and their names. answers: how many answers are spoiled; 0 off, -1 until cleared. */
int board_api_faults(void);
const char *board_api_fault_name(int fault);
bool board_api_fault(int index, int fault, int answers);

#pragma GCC visibility pop

#endif
