/* SPDX-License-Identifier: MIT
 * The boot loader's prompt, words, downloads, STK500 and block protocol: prompt.c and everything below it except the
 * registers.
 *
 * Input: bytes of the line, except: FE nn is a silence of nn * 100 ms (FE FE: the byte itself), FD presses or
 * releases START, and FC begins a block frame that gets a valid length and CRC (FC, command, number, count, that
 * many words). */
#include "fuzz.h"

/* All of memory.c except its two reads of the chip's own addresses. */
#define memory_next chip_memory_next
#define memory_fetch chip_memory_fetch
#include "firmware/boot/memory.c"
#undef memory_next
#undef memory_fetch

#include "check.h"
#include "firmware/common/crc16.h"
#include "memory.h"
#include "prompt.h"
#include "print.h"
#include "service.h"
#include "start.h"
#include "trap.h"
#include "uart.h"

#include <avr/eeprom.h>
#include <avr/wdt.h>
#include BOOT_PORTS_H
#include <setjmp.h>
#include <string.h>

#define TURNS_MAX 20000u      /* without a byte taken: the loader hangs */
#define LINE_BYTES 600u       /* the longest frame and more */

static uint8_t flash[MEM_BOOT_END], flash_before[MEM_BOOT_END], eeprom[MEM_EEPROM_BYTES];
static fuzz_t input;
static uint8_t line[LINE_BYTES];      /* the next bytes: a frame, or one byte */
static uint16_t line_at, line_count;
static uint32_t silence_ticks;        /* before `line` */
static uint16_t clock_ticks;
static bool start_down;
static uint32_t turns;
static unsigned given;                /* bytes sent by the loader since it last took one */
static jmp_buf over;
static enum { OVER_INPUT = 1, OVER_JUMP, OVER_RESET } why;

/* ---- the line ---- */

static void put_frame(void)
{
    line[line_count++] = 0xA5;
    uint8_t *content = &line[line_count];
    fuzz_bytes(&input, content, 3);
    content[2] = (uint8_t)(content[2] % 130);
    const unsigned bytes = 3 + 2u * content[2];
    fuzz_bytes(&input, content + 3, bytes - 3);
    const uint16_t crc = crc16_bytes(CRC16_START, content, (uint16_t)bytes);
    content[bytes] = (uint8_t)(crc >> 8);
    content[bytes + 1] = (uint8_t)crc;
    line_count = (uint16_t)(line_count + bytes + 2);
}

/* Makes the next bytes and the silence before them. false: the input is over. */
static bool fill(void)
{
    while (line_at == line_count) {
        if (fuzz_left(&input) == 0) {
            return false;
        }
        line_at = 0;
        line_count = 0;
        uint8_t byte = fuzz_byte(&input);
        if (byte == 0xFC) {
            put_frame();
        } else if (byte == 0xFD) {
            start_down = !start_down;
        } else if (byte == 0xFE && fuzz_left(&input) > 0 && *input.at != 0xFE) {
            silence_ticks += fuzz_byte(&input) * 1563u;
        } else {
            if (byte == 0xFE) {
                byte = fuzz_byte(&input);
            }
            line[line_count++] = byte;
        }
    }
    return true;
}

/* The input is over: permanent silence, longer than every time limit. Then the loader must wait at its prompt. */
static void end_of_input(void)
{
    if (turns++ > TURNS_MAX) {
        why = OVER_INPUT;
        longjmp(over, 1);
    }
}

void uart_open(uint8_t ubrr)
{
    ASSERT(ubrr == UART_UBRR_57143 || ubrr == UART_UBRR_117647);
}

void uart_put(uint8_t byte)
{
    (void)byte;
    /* 256 flash pages of READ answers and 20 lines per byte: no answer to one byte is longer. */
    ASSERT(++given < 3000000u);
}

void uart_flush(void)
{
}

uint8_t uart_has(void)
{
    clock_ticks++;
    if (!fill()) {
        end_of_input();
        return 0;
    }
    if (silence_ticks > 0) {
        silence_ticks--;
        return 0;
    }
    return line_count - line_at > 255 ? 255 : (uint8_t)(line_count - line_at);
}

uint8_t uart_peek(void)
{
    ASSERT(line_at < line_count);
    return line[line_at];
}

uint8_t uart_next(void)
{
    ASSERT(line_at < line_count);
    turns = 0;
    given = 0;
    return line[line_at++];
}

bool uart_wait(uint16_t ticks)
{
    if (!fill()) {
        end_of_input();
        clock_ticks = (uint16_t)(clock_ticks + ticks);
        return false;
    }
    if (silence_ticks >= ticks) {
        silence_ticks -= ticks;
        clock_ticks = (uint16_t)(clock_ticks + ticks);
        return false;
    }
    clock_ticks = (uint16_t)(clock_ticks + silence_ticks);
    silence_ticks = 0;
    return true;
}

bool uart_wait_for(uint8_t byte, uint16_t ticks)
{
    if (!uart_wait(ticks) || uart_peek() != byte) {
        return false;
    }
    (void)uart_next();
    return true;
}

void uart_drain(uint16_t ticks)
{
    while (uart_wait(ticks)) {
        (void)uart_next();
    }
}

uint16_t uart_clock(void)
{
    return ++clock_ticks;
}

uint16_t uart_since(uint16_t then)
{
    return (uint16_t)(uart_clock() - then);
}

void uart_pause(uint16_t ticks)
{
    clock_ticks = (uint16_t)(clock_ticks + ticks);
}

uint8_t uart_lost(void)
{
    return 0;
}

const boot_rx_t uart_rx;

/* ---- the chip ---- */

bool loader_start_pressed(void)
{
    return start_down;
}

void wdt_reset(void)
{
}

uint8_t loader_flash_byte(uint32_t addr)
{
    ASSERT(addr < sizeof flash);
    return flash[addr];
}

uint8_t eeprom_read_byte(const uint8_t *address)
{
    ASSERT((uintptr_t)address < sizeof eeprom);
    return eeprom[(uintptr_t)address];
}

void eeprom_update_byte(uint8_t *address, uint8_t value)
{
    ASSERT((uintptr_t)address < sizeof eeprom);
    eeprom[(uintptr_t)address] = value;
}

uint16_t boot_write_page(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode, const boot_rx_t *rx)
{
    ASSERT(addr % 256 == 0 && bytes >= 2 && bytes <= 256 && bytes % 2 == 0 && rx == &uart_rx);
    ASSERT(mode == BOOT_MODE_WRITE || mode == BOOT_MODE_PROGRAM);
    if (addr >= MEM_BOOT_START) {
        return BOOT_ERR_RANGE;
    }
    for (unsigned i = 0; i < 256 && mode == BOOT_MODE_WRITE; i++) {
        flash[addr + i] = 0xFF;
    }
    for (unsigned i = 0; i < bytes; i++) {
        flash[addr + i] &= data[i];
    }
    return BOOT_OK;
}

/* RAM reads as 0. */
uint8_t memory_next(void);
void memory_fetch(uint8_t *to, uint16_t count);

uint8_t memory_next(void)
{
    const uint32_t addr = memory_cursor.addr++;
    switch (addr >> 16) {
    case MEMORY_EEPROM >> 16: return eeprom[addr % sizeof eeprom];
    case MEMORY_RAM >> 16: ASSERT((addr & 0xFFFF) < MEM_RAM_END); return 0;
    default: return loader_flash_byte(addr % sizeof flash);
    }
}

void memory_fetch(uint8_t *to, uint16_t count)
{
    while (count-- > 0) {
        *to++ = memory_next();
    }
}

void start_jump(uint16_t word)
{
    (void)word;
    why = OVER_JUMP;
    longjmp(over, 1);
}

void start_reset(void)
{
    why = OVER_RESET;
    longjmp(over, 1);
}

/* ---- texts: print.c without the chip's addresses; check.c only reads memories ---- */

uint8_t print_byte(const void *progmem)
{
    return *(const uint8_t *)progmem;
}

void print_put(const char *text)
{
    while (*text != 0) {
        uart_put((uint8_t)*text++);
    }
}

void print_say(const char *text)
{
    print_line();
    print_put(text);
}

void print_nth(const char *text, uint8_t n)
{
    for (; n > 0; n--) {
        text += strlen(text) + 1;
    }
    print_put(text);
}

void print_line(void)
{
    print_put("\r\n ");
}

void print_hex8(uint8_t value)
{
    uart_put("0123456789ABCDEF"[value >> 4]);
    uart_put("0123456789ABCDEF"[value & 15]);
}

void print_hex16(uint16_t value)
{
    print_hex8((uint8_t)(value >> 8));
    print_hex8((uint8_t)value);
}

void print_hex32(uint32_t value)
{
    print_hex16((uint16_t)(value >> 16));
    print_hex16((uint16_t)value);
}

void check_all(void)
{
    print_say("CHECK");
}

void check_id(void)
{
    ASSERT(memory_app() <= MEMORY_APP_BAD);
    print_say("ID");
}

/* ---- */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input = (fuzz_t){data, data + size};
    memset(flash, 0xFF, sizeof flash);
    memset(eeprom, 0xFF, sizeof eeprom);
    for (unsigned i = 0; i < 0x2000; i++) {
        flash[MEM_BOOT_START + i] = (uint8_t)(i * 5 + (i >> 8));
    }
    memcpy(flash_before, flash, sizeof flash);
    memory_cursor.addr = 0;
    line_at = 0;
    line_count = 0;
    silence_ticks = 0;
    clock_ticks = 0;
    start_down = false;
    turns = 0;
    given = 0;
    if (setjmp(over) == 0) {
        prompt_run(size > 0 && data[0] == 0xFB);
    }
    ASSERT(why == OVER_INPUT || why == OVER_JUMP || why == OVER_RESET);
    ASSERT(memcmp(flash + MEM_BOOT_START, flash_before + MEM_BOOT_START, 0x2000) == 0);
    return 0;
}
