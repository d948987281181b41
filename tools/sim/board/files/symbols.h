/* SPDX-License-Identifier: MIT
 * symbols.h - names and addresses from the ELF files of the loaded images. */
#ifndef SIM_SYMBOLS_H
#define SIM_SYMBOLS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    char *name;
    uint32_t address; /* flash byte address, or data address for variables */
    uint32_t size;
    bool function;
    bool boot; /* part of the image in the boot section */
} symbol_t;

typedef struct {
    symbol_t *items;
    size_t count, room;
    /* End of the variables of each image: application (below 0x1E000), boot section. 0: unknown. */
    uint32_t variables_end[2];
} symbols_t;

/* Adds the symbols of one ELF file. Drops those of an earlier image in the same section (application or boot). false:
 * not a readable ELF file with symbols; nothing changed. */
bool symbols_load(symbols_t *symbols, const char *path, bool boot);
void symbols_free(symbols_t *symbols);

/* Drops the symbols of an image of which the firmware has erased a function in these `count` bytes: what it writes there
 * has other names. */
void symbols_erased(symbols_t *symbols, uint32_t address, uint32_t count);

/* NULL if there is none. By name: an exact match, else a match up to a dot. By address: the nearest function before
 * it. */
const symbol_t *symbols_find(const symbols_t *symbols, const char *name, bool function);
const symbol_t *symbols_at(const symbols_t *symbols, uint32_t flash_address);

#endif
