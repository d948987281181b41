/* SPDX-License-Identifier: MIT */
#include "elf_image.h"

#include <gelf.h>

#define FLASH_LIMIT 0x800000u /* the linker puts the data space, EEPROM, fuses and lock bits at or above this address */

static image_status_t take_segment(Elf *elf, const GElf_Phdr *segment, image_t *image)
{
    if (segment->p_type != PT_LOAD || segment->p_filesz == 0 || segment->p_paddr >= FLASH_LIMIT) {
        return IMAGE_OK;
    }
    Elf_Data *data = elf_getdata_rawchunk(elf, (int64_t)segment->p_offset, segment->p_filesz, ELF_T_BYTE);
    if (!data) {
        return IMAGE_SYNTAX;
    }
    return image_put(image, (uint32_t)segment->p_paddr, data->d_buf, segment->p_filesz) ? IMAGE_OK : IMAGE_RANGE;
}

static image_status_t take_all(Elf *elf, image_t *image)
{
    GElf_Ehdr header;
    size_t count;
    if (elf_kind(elf) != ELF_K_ELF || !gelf_getehdr(elf, &header) || header.e_machine != EM_AVR ||
        elf_getphdrnum(elf, &count) != 0) {
        return IMAGE_SYNTAX;
    }
    for (size_t i = 0; i < count; i++) {
        GElf_Phdr segment;
        image_status_t status =
            gelf_getphdr(elf, (int)i, &segment) ? take_segment(elf, &segment, image) : IMAGE_SYNTAX;
        if (status != IMAGE_OK) {
            return status;
        }
    }
    return IMAGE_OK;
}

image_status_t elf_image_read(FILE *file, image_t *image)
{
    elf_version(EV_CURRENT);
    Elf *elf = elf_begin(fileno(file), ELF_C_READ, NULL);
    if (!elf) {
        return IMAGE_SYNTAX;
    }
    image_status_t status = take_all(elf, image);
    elf_end(elf);
    return status;
}
