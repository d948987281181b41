/* SPDX-License-Identifier: MIT
 * machine_page.c - requests that bring a page in, for images that have a page in RAM. */
#include "machine_parts.h"

#include <string.h>
#include "crc16.h"
#include "text.h"

#define DATA_BYTES_MAX 32u

static uint8_t image_error(void)
{
    (void)machine_error(MACHINE_ERR_IMAGE);
    TEXT("Not in this image");
    return MACHINE_ERR_IMAGE;
}

static machine_status_t image_result(machine_status_t status)
{
    switch (status) {
    case MACHINE_OK:
        machine_end_ok();
        break;
    case MACHINE_ERR_UNSAVED:
        (void)machine_error(status);
        TEXT("The open page has edits that are not saved");
        break;
    case MACHINE_ERR_BUSY:
        (void)machine_error(status);
        TEXT("Not while something plays");
        break;
    default:
        (void)machine_error(status);
        TEXT("The page could not be saved");
        break;
    }
    return status;
}

uint8_t machine_do_open(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    uint16_t page;
    if (machine->image->open == NULL) {
        return image_error();
    }
    if (!machine_number(args, 1, 0, PAGE_COUNT - 1, &page)) {
        return machine_range_error(TEXT_P("Page"), 0, PAGE_COUNT - 1);
    }
    return image_result(machine->image->open(machine->image->context, (uint8_t)page));
}

uint8_t machine_do_data(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    uint16_t offset;
    uint8_t bytes[DATA_BYTES_MAX];
    const char *hex = shell_word(args, 2);
    const uint8_t count = (uint8_t)(strlen(hex) / 2);
    if (machine->image->ram_page == NULL) {
        return image_error();
    }
    if (!machine_number(args, 1, 0, PAGE_BYTES - 1, &offset) || offset + count > PAGE_BYTES) {
        return machine_range_error(TEXT_P("Offset and data"), 0, PAGE_BYTES - 1);
    }
    if (count > DATA_BYTES_MAX) {
        return machine_range_error(TEXT_P("Bytes of data"), 1, DATA_BYTES_MAX);
    }
    for (uint8_t i = 0; hex[i] != '\0'; i++) {
        const uint8_t digit = shell_digit(hex[i]);
        if (digit > 15 || (i == 2 * count)) {
            (void)machine_error(MACHINE_ERR_RANGE);
            TEXT("Data must be pairs of hexadecimal digits");
            return MACHINE_ERR_RANGE;
        }
        bytes[i / 2] = (uint8_t)(bytes[i / 2] << 4 | digit);
    }
    memcpy(machine->image->ram_page(machine->image->context) + offset, bytes, count);
    if (machine->image->changed != NULL) {
        machine->image->changed(machine->image->context);
    }
    machine_end_ok();
    return MACHINE_OK;
}

static uint16_t ram_crc(const machine_t *machine)
{
    return crc16_bytes(CRC16_START, machine->image->ram_page(machine->image->context), PAGE_BYTES);
}

uint8_t machine_do_crc(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    (void)args;
    if (machine->image->ram_page == NULL) {
        return image_error();
    }
    text_put(' ');
    text_hex(ram_crc(machine), 4);
    machine_end_ok();
    return MACHINE_OK;
}

uint8_t machine_do_save(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    uint16_t page, crc;
    if (machine->image->save == NULL || machine->image->ram_page == NULL) {
        return image_error();
    }
    if (!machine_number(args, 1, 0, PAGE_COUNT - 1, &page)) {
        return machine_range_error(TEXT_P("Page"), 0, PAGE_COUNT - 1);
    }
    if (!shell_parse(shell_word(args, 2), true, &crc) || crc != ram_crc(machine)) {
        (void)machine_error(MACHINE_ERR_CRC);
        TEXT("The CRC does not fit the page in RAM");
        return MACHINE_ERR_CRC;
    }
    return image_result(machine->image->save(machine->image->context, (uint8_t)page));
}

