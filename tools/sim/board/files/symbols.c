/* SPDX-License-Identifier: MIT */
#include "symbols.h"

#include <fcntl.h>
#include <gelf.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "m128.h"

#define AVR_DATA_OFFSET 0x800000u /* where the linker puts the data space */
#define AVR_EEPROM_OFFSET 0x810000u

static bool in_boot(uint32_t address) { return address >= M128_NRWW_START; }

static void drop_image(symbols_t *symbols, bool boot)
{
    size_t kept = 0;
    for (size_t i = 0; i < symbols->count; i++) {
        symbol_t *symbol = &symbols->items[i];
        if (symbol->boot == boot) {
            free(symbol->name);
        } else {
            symbols->items[kept++] = *symbol;
        }
    }
    symbols->count = kept;
    symbols->variables_end[boot] = 0;
}

static void add(symbols_t *symbols, symbol_t symbol)
{
    if (symbols->count == symbols->room) {
        size_t room = symbols->room ? symbols->room * 2 : 256;
        symbol_t *items = realloc(symbols->items, room * sizeof *items);
        if (!items) {
            return;
        }
        symbols->items = items;
        symbols->room = room;
    }
    symbol.name = strdup(symbol.name);
    if (symbol.name) {
        symbols->items[symbols->count++] = symbol;
    }
}

/* Newer assemblers keep local labels in the file: .L4, .Loc.3, L0 with a control character. */
static bool is_local_label(const char *name) { return name[0] == '.' || strchr(name, '\001'); }

static void take_symbol(symbols_t *symbols, const char *name, const GElf_Sym *raw, bool boot)
{
    uint32_t value = (uint32_t)raw->st_value;
    bool data = value >= AVR_DATA_OFFSET && value < AVR_EEPROM_OFFSET;
    int type = GELF_ST_TYPE(raw->st_info);
    if (strcmp(name, "_end") == 0 && data) {
        symbols->variables_end[boot] = value - AVR_DATA_OFFSET;
    }
    if (!name[0] || is_local_label(name) || raw->st_shndx == SHN_UNDEF || raw->st_shndx == SHN_ABS || type == STT_FILE ||
        type == STT_SECTION) {
        return;
    }
    if (data) {
        add(symbols, (symbol_t){ (char *)name, value - AVR_DATA_OFFSET, (uint32_t)raw->st_size, false, boot });
    } else if (value < M128_FLASH_BYTES && in_boot(value) == boot) {
        add(symbols, (symbol_t){ (char *)name, value, (uint32_t)raw->st_size, true, boot });
    }
}

static bool read_table(symbols_t *symbols, Elf *elf, bool boot)
{
    Elf_Scn *section = NULL;
    while ((section = elf_nextscn(elf, section)) != NULL) {
        GElf_Shdr header;
        Elf_Data *data = elf_getdata(section, NULL);
        if (!gelf_getshdr(section, &header) || header.sh_type != SHT_SYMTAB || !data) {
            continue;
        }
        drop_image(symbols, boot);
        size_t count = header.sh_size / header.sh_entsize;
        for (size_t i = 0; i < count; i++) {
            GElf_Sym raw;
            const char *name = NULL;
            if (gelf_getsym(data, (int)i, &raw)) {
                name = elf_strptr(elf, header.sh_link, raw.st_name);
            }
            if (name) {
                take_symbol(symbols, name, &raw, boot);
            }
        }
        return true;
    }
    return false;
}

bool symbols_load(symbols_t *symbols, const char *path, bool boot)
{
    int file = open(path, O_RDONLY);
    if (file < 0) {
        return false;
    }
    bool read = false;
    elf_version(EV_CURRENT);
    Elf *elf = elf_begin(file, ELF_C_READ, NULL);
    if (elf) {
        read = elf_kind(elf) == ELF_K_ELF && read_table(symbols, elf, boot);
        elf_end(elf);
    }
    close(file);
    return read;
}

void symbols_erased(symbols_t *symbols, uint32_t address, uint32_t count)
{
    for (size_t i = 0; i < symbols->count; i++) {
        const symbol_t *symbol = &symbols->items[i];
        if (symbol->function && symbol->address < address + count && address < symbol->address + symbol->size) {
            drop_image(symbols, symbol->boot);
            return;
        }
    }
}

void symbols_free(symbols_t *symbols)
{
    for (size_t i = 0; i < symbols->count; i++) {
        free(symbols->items[i].name);
    }
    free(symbols->items);
    memset(symbols, 0, sizeof *symbols);
}

const symbol_t *symbols_find(const symbols_t *symbols, const char *name, bool function)
{
    size_t length = strlen(name);
    const symbol_t *found = NULL;
    for (size_t i = 0; i < symbols->count; i++) {
        const symbol_t *symbol = &symbols->items[i];
        if (symbol->function == function && strncmp(symbol->name, name, length) == 0) {
            if (symbol->name[length] == 0) {
                return symbol;
            }
            if (symbol->name[length] == '.' && !found) {
                found = symbol;
            }
        }
    }
    return found;
}

/* Takes the nearest function at or before the address, because labels in start-up code have no size. Of several at one
 * address, the one with a size (a function) is the better name. */
const symbol_t *symbols_at(const symbols_t *symbols, uint32_t flash_address)
{
    const symbol_t *found = NULL;
    for (size_t i = 0; i < symbols->count; i++) {
        const symbol_t *symbol = &symbols->items[i];
        if (!symbol->function || symbol->address > flash_address || symbol->boot != in_boot(flash_address)) {
            continue;
        }
        if (!found || symbol->address > found->address ||
            (symbol->address == found->address && symbol->size > found->size)) {
            found = symbol;
        }
    }
    return found;
}
