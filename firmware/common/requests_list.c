/* SPDX-License-Identifier: MIT
 * requests_list.c - requests that read the pages in flash: list, page, dense, crcs. */
#include "requests.h"

#include <stddef.h>
#include "crc16.h"
#include "report.h"
#include "text.h"

#define CHUNK_BYTES 32u   /* a page is read in chunks of this size, on the stack */

/* Prints number:steps:"name", or number:!:"fault"; nothing for an empty page. */
static void print_list_entry(uint8_t page)
{
    uint8_t header[PAGE_AT_STEPS + 1];
    const bool good = page_store_is_good(requests_image.pages, page);
    page_store_read(page, 0, header, sizeof header);
    if (good ? header[PAGE_AT_NAME] == '\0' && header[PAGE_AT_STEPS] == 0 : page_store_is_erased(page)) {
        return;
    }
    text_put(' ');
    text_number(page);
    text_put(':');
    if (!good) {
        TEXT("!:\"");
        text_P(report_page_fault_P(page_store_check(requests_image.pages, page)));
        text_put('"');
        return;
    }
    text_number(header[PAGE_AT_STEPS]);
    char name[PAGE_NAME_BYTES];
    page_store_name(page, name);
    TEXT(":\"");
    for (const char *c = name; *c != '\0'; c++) {
        text_put(*c == '"' ? '\'' : *c);
    }
    text_put('"');
}

/* Takes the last page of a request that names a first and a last page, or none for all pages. */
static uint8_t take_pages(const shell_args_t *args, uint8_t *last)
{
    *last = args->count > 1 ? (uint8_t)args->number[1] : PAGE_COUNT - 1u;
    if (args->count == 2) {
        return SHELL_ERR_COUNT;
    }
    if (*last < args->number[0]) {
        (void)requests_error(REQUEST_ERR_RANGE);
        shell_print_range(TEXT_P("Page"), (int16_t)args->number[0], PAGE_COUNT - 1, false);
        return SHELL_ERR_REPORTED;
    }
    return REQUEST_OK;
}

uint8_t request_list(const shell_args_t *args)
{
    uint8_t last;
    const uint8_t status = take_pages(args, &last);
    if (status != REQUEST_OK) {
        return status;
    }
    for (uint16_t page = args->number[0]; page <= last; page++) {
        print_list_entry((uint8_t)page);
        requests_image.serve(); /* pages without an entry take up to 2 ms each */
    }
    return REQUEST_OK;
}

typedef void (*print_byte_t)(uint8_t byte);

static void print_hex(uint8_t byte)
{
    text_hex(byte, 2);
}

/* Prints six bits per character: the low six of each byte, and after every three bytes (the first time after two) a
 * character with their high bits. */
static struct {
    uint8_t high_bits;           /* of the newest byte in bits 7 and 6, of older ones below */
    uint8_t bytes;               /* number of bytes whose high bits are not printed yet */
} dense;

static void print_dense(uint8_t byte)
{
    text_put('0' + (byte & 0x3Fu));
    dense.high_bits = dense.high_bits >> 2 | (byte & 0xC0u);
    if (++dense.bytes == 3) {
        dense.bytes = 0;
        text_put((char)('0' + (dense.high_bits >> 2)));
    }
}

/* Returns the CRC of the 512 bytes of a page in flash. print: called for each byte; or NULL. */
static uint16_t page_crc(uint8_t page, print_byte_t print)
{
    uint16_t crc = CRC16_START;
    for (uint16_t offset = 0; offset < PAGE_BYTES; offset += CHUNK_BYTES) {
        uint8_t bytes[CHUNK_BYTES];
        page_store_read(page, offset, bytes, sizeof bytes);
        crc = crc16_bytes(crc, bytes, sizeof bytes);
        for (uint8_t i = 0; print != NULL && i < sizeof bytes; i++) {
            print(bytes[i]);
        }
    }
    return crc;
}

static uint8_t answer_page(const shell_args_t *args, print_byte_t print)
{
    const uint8_t page = (uint8_t)args->number[0];
    text_put(' ');
    text_number(page);
    text_put(' ');
    const uint16_t crc = page_crc(page, print);
    text_put(' ');
    text_hex(crc, 4);
    return REQUEST_OK;
}

uint8_t request_page(const shell_args_t *args)
{
    return answer_page(args, print_hex);
}

/* The same with two thirds of the characters. */
uint8_t request_dense(const shell_args_t *args)
{
    dense.high_bits = 0;
    dense.bytes = 1; /* two bytes first: 512 = 2 + 3 * 170 */
    return answer_page(args, print_dense);
}

/* Prints four digits per page without spaces, so that 128 pages take 512 characters. */
uint8_t request_crcs(const shell_args_t *args)
{
    uint8_t last;
    const uint8_t status = take_pages(args, &last);
    if (status != REQUEST_OK) {
        return status;
    }
    text_put(' ');
    for (uint16_t page = args->number[0]; page <= last; page++) {
        text_hex(page_crc((uint8_t)page, NULL), 4);
        requests_image.serve();
    }
    return REQUEST_OK;
}
