/* SPDX-License-Identifier: MIT
 * symbols.h - names and addresses from the ELF files that belong to the loaded images. */
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
    bool boot; /* of the image in the boot section */
} symbol_t;

typedef struct {
    symbol_t *items;
    size_t count, room;
    /* End of variables by image: below 0x1E000, and boot section. 0: not known. */
    uint32_t variables_end[2];
} symbols_t;

/* Adds the symbols of one ELF file. Symbols of an image loaded earlier at the same place (application or boot
 * section) are dropped. false: not a readable AVR ELF file; nothing changed. */
bool symbols_load(symbols_t *symbols, const char *path, bool boot);
void symbols_free(symbols_t *symbols);

/* NULL if there is none. By name: equal, or equal up to a dot. By address: the function that covers it. */
const symbol_t *symbols_find(const symbols_t *symbols, const char *name, bool function);
const symbol_t *symbols_at(const symbols_t *symbols, uint32_t flash_address);

#endif
