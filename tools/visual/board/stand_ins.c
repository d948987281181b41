/* SPDX-License-Identifier: MIT
 * Stubs for parts that the page does not use: GDB, wave files, ELF files. They replace simavr's sim_gdb.c,
 * sim_vcd_file.c and sim_cmds.c, and gdb.c, elf_image.c and symbols.c of tools/sim/board, which need sockets, files and
 * libelf. Without symbols a violation gives an address but no function, and the stack guard ends at the start of the
 * SRAM. */
#include <stdio.h>

#include "elf_image.h"
#include "sim_avr.h"
#include "sim_cmds.h"
#include "sim_gdb.h"
#include "sim_vcd_file.h"
#include "symbols.h"

int avr_gdb_init(avr_t *avr)
{
    (void)avr;
    return -1;
}

void avr_deinit_gdb(avr_t *avr) { (void)avr; }

int avr_gdb_processor(avr_t *avr, int sleep)
{
    (void)avr;
    (void)sleep;
    return 0;
}

void avr_gdb_handle_watchpoints(avr_t *avr, uint16_t address, enum avr_gdb_watch_type type)
{
    (void)avr;
    (void)address;
    (void)type;
}

void avr_vcd_close(avr_vcd_t *vcd) { (void)vcd; }

void avr_cmd_init(avr_t *avr) { (void)avr; }

image_status_t elf_image_read(FILE *file, image_t *image)
{
    (void)file;
    (void)image;
    return IMAGE_SYNTAX;
}

bool symbols_load(symbols_t *symbols, const char *path, bool boot)
{
    (void)symbols;
    (void)path;
    (void)boot;
    return false;
}

void symbols_free(symbols_t *symbols) { (void)symbols; }

void symbols_erased(symbols_t *symbols, uint32_t address, uint32_t count)
{
    (void)symbols;
    (void)address;
    (void)count;
}

const symbol_t *symbols_find(const symbols_t *symbols, const char *name, bool function)
{
    (void)symbols;
    (void)name;
    (void)function;
    return NULL;
}

const symbol_t *symbols_at(const symbols_t *symbols, uint32_t flash_address)
{
    (void)symbols;
    (void)flash_address;
    return NULL;
}
