/* SPDX-License-Identifier: MIT
 * machine_page.c - requests that bring a page in, for images that have a page in RAM. */
#include "machine_parts.h"

#include <string.h>
#include "bound.h"
#include "crc16.h"
#include "text.h"

#define DATA_BYTES_MAX 32u

/* An image with a page in RAM has all the functions for it. */
static bool has_page(const machine_t *machine)
{
    if (MACHINE_IMAGE(machine)->ram_page != NULL) {
        return true;
    }
    (void)machine_says(MACHINE_ERR_IMAGE, TEXT_P("Not in this image"));
    return false;
}

static uint8_t image_result(uint8_t status)
{
    return status == MACHINE_OK ? status
           : machine_says(status, status == MACHINE_ERR_UNSAVED ? TEXT_P("The open page has edits that are not saved")
                                  : status == MACHINE_ERR_BUSY  ? TEXT_P("Not while something plays")
                                                                : TEXT_P("The page could not be saved"));
}

uint8_t machine_do_open(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    uint16_t page;
    if (!has_page(machine)) {
        return MACHINE_ERR_IMAGE;
    }
    if (!machine_page_number(args, 1, 0, &page)) {
        return MACHINE_ERR_RANGE;
    }
    return image_result(MACHINE_IMAGE(machine)->open(MACHINE_IMAGE(machine)->context, (uint8_t)page));
}

uint8_t machine_do_data(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    uint16_t offset;
    uint8_t bytes[DATA_BYTES_MAX];
    const char *hex = shell_word(args, 2);
    const uint8_t count = (uint8_t)(strlen(hex) / 2);
    if (!has_page(machine)) {
        return MACHINE_ERR_IMAGE;
    }
    if (!machine_number(args, 1, TEXT_P("Offset and data"), 0, PAGE_BYTES - 1, &offset)) {
        return MACHINE_ERR_RANGE;
    }
    if (count > DATA_BYTES_MAX || offset + count > PAGE_BYTES) {
        machine_range_error(TEXT_P("Bytes of data"), 1, DATA_BYTES_MAX);
        return MACHINE_ERR_RANGE;
    }
    for (uint8_t i = 0; hex[i] != '\0'; i++) {
        const uint8_t digit = shell_digit(hex[i]);
        if (digit > 15 || (i == 2 * count)) {
            return machine_says(MACHINE_ERR_RANGE, TEXT_P("Data must be pairs of hexadecimal digits"));
        }
        bytes[i / 2] = (uint8_t)(bytes[i / 2] << 4 | digit);
    }
    memcpy(MACHINE_IMAGE(machine)->ram_page(MACHINE_IMAGE(machine)->context) + offset, bytes, count);
    MACHINE_IMAGE(machine)->changed(MACHINE_IMAGE(machine)->context);
    return MACHINE_OK;
}

static uint16_t ram_crc(const machine_t *machine)
{
    return crc16_bytes(CRC16_START, MACHINE_IMAGE(machine)->ram_page(MACHINE_IMAGE(machine)->context), PAGE_BYTES);
}

uint8_t machine_do_crc(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    (void)args;
    if (!has_page(machine)) {
        return MACHINE_ERR_IMAGE;
    }
    text_put(' ');
    text_hex(ram_crc(machine), 4);
    return MACHINE_OK;
}

uint8_t machine_do_save(void *context, const shell_args_t *args)
{
    machine_t *machine = context;
    uint16_t page, crc;
    if (!has_page(machine)) {
        return MACHINE_ERR_IMAGE;
    }
    if (!machine_page_number(args, 1, 0, &page)) {
        return MACHINE_ERR_RANGE;
    }
    if (!shell_parse(shell_word(args, 2), true, &crc) || crc != ram_crc(machine)) {
        return machine_says(MACHINE_ERR_CRC, TEXT_P("The CRC does not fit the page in RAM"));
    }
    return image_result(MACHINE_IMAGE(machine)->save(MACHINE_IMAGE(machine)->context, (uint8_t)page));
}

