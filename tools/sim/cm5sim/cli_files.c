/* SPDX-License-Identifier: MIT */
#include "cli_files.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "board_memory.h"
#include "memory_map.h"

#define FLASH_BYTES 0x20000
#define MOTION_BYTES (MEM_MOTION_END - MEM_MOTION_START)
#define MOTION_PAGE_BYTES 512 /* a 65,024-byte file has no page 0 */

static char message[512];

static const char *explain(const char *path, const char *why)
{
    snprintf(message, sizeof message, "%s: %s", path, why);
    return message;
}

/* Reads a whole file of at most size bytes. Returns its length, or -1 (errno; EFBIG: longer). */
static long read_file(const char *path, uint8_t *to, size_t size)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return -1;
    }
    const size_t count = fread(to, 1, size, file);
    const bool longer = fgetc(file) != EOF, failed = ferror(file) != 0;
    fclose(file);
    errno = failed ? EIO : longer ? EFBIG : 0;
    return failed || longer ? -1 : (long)count;
}

/* Writes beside the file first, so that a full disk costs no robot its pages. */
static const char *write_file(const char *path, const uint8_t *from, size_t size)
{
    char beside[400];
    if (snprintf(beside, sizeof beside, "%s.new", path) >= (int)sizeof beside) {
        return explain(path, "the name is too long");
    }
    FILE *file = fopen(beside, "wb");
    if (file == NULL) {
        return explain(beside, strerror(errno));
    }
    const bool written = fwrite(from, 1, size, file) == size;
    if (fclose(file) != 0 || !written || rename(beside, path) != 0) {
        return explain(path, strerror(errno));
    }
    return NULL;
}

const char *files_load_image(board_t *board, const char *name)
{
    char built[400];
    const char *path = name;
    const char *build = getenv("M512_BUILD");
    const int length = build ? snprintf(built, sizeof built, "%s/firmware/%s", build, name)
                             : snprintf(built, sizeof built, "%s/%s", CM5SIM_FIRMWARE_DIR, name);
    if (access(name, R_OK) != 0 && name[0] != '/' && length < (int)sizeof built && access(built, R_OK) == 0) {
        path = built;
    }
    if (access(path, R_OK) != 0) {
        return explain(name, strerror(errno));
    }
    return board_load(board, path, 0) ? NULL : explain(path, board_error(board));
}

const char *files_load_motions(board_t *board, const char *path)
{
    uint8_t image[MOTION_BYTES];
    const size_t length = strlen(path);
    if (length > 4 && strcmp(path + length - 4, ".hex") == 0) {
        return board_load(board, path, 0) ? NULL : explain(path, board_error(board));
    }
    const long count = read_file(path, image, sizeof image);
    if (count < 0) {
        return explain(path, strerror(errno));
    }
    if (count != MOTION_BYTES && count != MOTION_BYTES - MOTION_PAGE_BYTES) {
        return explain(path, "a motion area has 65,536 bytes (or 65,024 without page 0)");
    }
    const uint32_t start = MEM_MOTION_END - (uint32_t)count;
    return board_flash_write(board, start, image, (size_t)count) == (size_t)count ? NULL : explain(path, "no room");
}

/* A file of exactly size bytes, or none. */
static const char *read_exact(const char *path, uint8_t *to, long size, bool *found)
{
    const long count = read_file(path, to, (size_t)size);
    *found = count == size;
    if (count == size || (count < 0 && errno == ENOENT)) {
        return NULL;
    }
    if (count < 0 && errno != EFBIG) {
        return explain(path, strerror(errno));
    }
    static char why[80];
    snprintf(why, sizeof why, "not a file of this kind: it must have %ld bytes", size);
    return explain(path, why);
}

const char *files_load_flash(board_t *board, const char *path, bool *found)
{
    static uint8_t bytes[FLASH_BYTES];
    const char *error = read_exact(path, bytes, FLASH_BYTES, found);
    if (*found) {
        board_flash_write(board, 0, bytes, FLASH_BYTES);
    }
    return error;
}

const char *files_save_flash(board_t *board, const char *path)
{
    static uint8_t bytes[FLASH_BYTES];
    board_flash_read(board, 0, bytes, FLASH_BYTES);
    return write_file(path, bytes, FLASH_BYTES);
}

const char *files_load_eeprom(board_t *board, const char *path)
{
    uint8_t bytes[MEM_EEPROM_BYTES];
    bool found;
    const char *error = read_exact(path, bytes, MEM_EEPROM_BYTES, &found);
    if (found) {
        board_eeprom_write(board, 0, bytes, MEM_EEPROM_BYTES);
    }
    return error;
}

const char *files_save_eeprom(board_t *board, const char *path)
{
    uint8_t bytes[MEM_EEPROM_BYTES];
    board_eeprom_read(board, 0, bytes, MEM_EEPROM_BYTES);
    return write_file(path, bytes, MEM_EEPROM_BYTES);
}

/* One record of SERVO_EEPROM_BYTES for each servo, in order of plugging in. */
const char *files_load_servos(servo_bus_t *bus, const char *path)
{
    uint8_t bytes[254 * SERVO_EEPROM_BYTES];
    bool found;
    const char *error = read_exact(path, bytes, bus->count * SERVO_EEPROM_BYTES, &found);
    for (int i = 0; found && i < bus->count; i++) {
        memcpy(bus->servos[i]->table, bytes + i * SERVO_EEPROM_BYTES, SERVO_EEPROM_BYTES);
    }
    return error;
}

const char *files_save_servos(const servo_bus_t *bus, const char *path)
{
    uint8_t bytes[254 * SERVO_EEPROM_BYTES];
    const int count = bus->count < 254 ? bus->count : 254;
    for (int i = 0; i < count; i++) {
        memcpy(bytes + i * SERVO_EEPROM_BYTES, bus->servos[i]->table, SERVO_EEPROM_BYTES);
    }
    return write_file(path, bytes, (size_t)count * SERVO_EEPROM_BYTES);
}

const char *files_plug_in_servos(servo_bus_t *bus, const options_t *options, uint64_t now_cycles)
{
    for (int i = 0; i < options->servo_count; i++) {
        const servo_plan_t *plan = &options->servos[i];
        if (servo_bus_add(bus, plan->id, plan->model, plan->rate_bps) == NULL) {
            return "no memory for the servos";
        }
    }
    const char *error = options->servo_eeprom ? files_load_servos(bus, options->servo_eeprom) : NULL;
    for (int i = 0; i < options->fault_count && error == NULL; i++) {
        servo_t *servo = servo_bus_find(bus, options->faults[i].id);
        if (servo == NULL) {
            return "--fault: there is no servo with that ID";
        }
        servo_bus_fault(bus, now_cycles, servo, options->faults[i].fault, SERVO_FAULT_ALWAYS);
    }
    return error;
}
