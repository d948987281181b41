/* SPDX-License-Identifier: MIT
 * cli_files.h - firmware images, motion area, and what a robot keeps without power: flash, EEPROM, the servos'
 * EEPROM areas. Each function returns NULL or a sentence that says what went wrong (good until the next call). */
#ifndef CLI_FILES_H
#define CLI_FILES_H

#include "board.h"
#include "cli_options.h"
#include "servo_bus.h"

/* Loads a firmware image (.hex .elf .bin). A relative name that is not here is looked for in
 * build/firmware. */
const char *files_load_image(board_t *board, const char *name);

/* Loads the 64 KiB motion area: raw 65,536 bytes, 65,024 bytes (from page 1 on), or Intel HEX. */
const char *files_load_motions(board_t *board, const char *path);

/* Plugs in the servos that the options ask for, with their EEPROM file and faults. */
const char *files_plug_in_servos(servo_bus_t *bus, const options_t *options, uint64_t now_cycles);

/* A memory from its file, if there is one (*found), and back into it. */
const char *files_load_flash(board_t *board, const char *path, bool *found);
const char *files_save_flash(board_t *board, const char *path);
const char *files_load_eeprom(board_t *board, const char *path);
const char *files_save_eeprom(board_t *board, const char *path);
const char *files_load_servos(servo_bus_t *bus, const char *path);
const char *files_save_servos(const servo_bus_t *bus, const char *path);

#endif
