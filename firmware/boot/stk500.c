/* SPDX-License-Identifier: MIT */
#include "stk500.h"

#include "memory.h"
#include "print.h"
#include "uart.h"

#include <avr/boot.h>
#include <avr/interrupt.h>

#define GAP_TICKS UART_TICKS(250)   /* inside a command */
#define IDLE_SLICES 4u              /* of 2.5 s between commands */
#define SLICE_TICKS UART_TICKS(2500)
#define DEVICE_CODE 0xB2            /* ATmega128 in SET_DEVICE */

enum { SYNC_EOP = 0x20, INSYNC = 0x14, NOSYNC = 0x15, OK = 0x10, FAILED = 0x11, NODEVICE = 0x13 };
enum { GET_SYNC = 0x30, SET_PARM = 0x40, GET_PARM = 0x41, SET_DEVICE = 0x42, SET_DEVICE_EXT = 0x45,
       ENTER = 0x50, LEAVE = 0x51, CHIP_ERASE = 0x52, LOAD_ADDRESS = 0x55, UNIVERSAL = 0x56, PROG_PAGE = 0x64,
       READ_PAGE = 0x74, READ_SIGN = 0x75 };
enum { READ_FUSE = 0x50, ERASE_CHIP = 0x80 }; /* bytes of UNIVERSAL */

/* A command and the number of its bytes before SYNC_EOP, not counting the data of PROG_PAGE. */
static const uint8_t commands[] PROGMEM_GAP = {
    GET_SYNC, 0, SET_PARM, 2, GET_PARM, 1, SET_DEVICE, 20, SET_DEVICE_EXT, 5, ENTER, 0, LEAVE, 0,
    CHIP_ERASE, 0, LOAD_ADDRESS, 2, UNIVERSAL, 4, PROG_PAGE, 3, READ_PAGE, 3, READ_SIGN, 0, 0};

static struct {
    uint8_t args[20];
    uint16_t address;  /* of LOAD_ADDRESS, in words: avrdude's arduino programmer halves EEPROM addresses too */
    bool is_entered;
    bool is_broken;    /* the line went silent inside a command */
} stk;

static uint8_t take(void)
{
    if (uart_wait(GAP_TICKS)) {
        return uart_next();
    }
    stk.is_broken = true;
    return 0;
}

/* Returns 0xFF for an unknown command. */
static uint8_t arg_count(uint8_t command)
{
    for (uint8_t i = 0;; i += 2) {
        uint8_t known = print_byte(&commands[i]);
        if (known == 0) {
            return 0xFF;
        }
        if (known == command) {
            return print_byte(&commands[i + 1]);
        }
    }
}

static uint16_t length(void)
{
    return stk.args[0] << 8 | stk.args[1];
}

static bool is_flash(void)
{
    return stk.args[2] == 'F';
}

/* take_command has already merged a partial block with the rest of its flash page. */
static bool program(void)
{
    uint16_t count = length();
    if (!stk.is_entered || count > FLASH_PAGE_BYTES) {
        return false;
    }
    if (is_flash()) {
        return (uint8_t)(stk.address << 1) + count <= FLASH_PAGE_BYTES &&
               memory_write_work(stk.address >> 7);
    }
    return stk.address < MEM_EEPROM_BYTES / 2 && memory_ee_write(stk.address << 1, memory_work, count);
}

static void read(void)
{
    memory_seek(((uint32_t)stk.address << 1) + (is_flash() ? 0 : MEMORY_EEPROM));
    for (uint16_t count = length(); count > 0; count--) {
        uart_put(memory_next());
    }
}

/* An instruction of serial programming. 50 00, 58 00, 50 08, 58 08 read low fuse, lock bits, extended and high fuse: numbers
 * 0 to 3 here (data sheet, "Reading the Fuse and Lock Bits from Software"). AC 80 is chip erase. The rest, such as writing a
 * fuse, is refused. */
static uint8_t universal(void)
{
    uint8_t first = stk.args[0], second = stk.args[1];
    uint8_t number = 0;
    if (first & 8) {
        number += 1;
    }
    if (second & 8) {
        number += 2;
    }
    cli(); /* an interrupt between the two instructions of the read would make it read flash */
    uint8_t value = boot_lock_fuse_bits_get(number);
    sei();
    uart_put(value);
    return (first & ~8) == READ_FUSE || second == ERASE_CHIP ? OK : FAILED;
}

/* Sends the data between INSYNC and OK; returns the last byte of the answer. */
static uint8_t carry_out(uint8_t command)
{
    switch (command) {
    case GET_PARM: uart_put(3); break;
    case SET_DEVICE: return stk.args[0] == DEVICE_CODE ? OK : NODEVICE;
    case ENTER: stk.is_entered = true; break;
    case LOAD_ADDRESS: stk.address = stk.args[0] | stk.args[1] << 8; break;
    case UNIVERSAL: return universal();
    case PROG_PAGE: return program() ? OK : FAILED;
    case READ_PAGE: read(); break;
    case READ_SIGN: PUT("\x1E\x97\x02"); break;
    case LEAVE: memory_download_good(); break;
    default: break;
    }
    return OK;
}

/* Receives `count` arguments, data and SYNC_EOP of a command. */
static bool take_command(uint8_t command, uint8_t count)
{
    for (uint8_t i = 0; i < count; i++) {
        stk.args[i] = take();
    }
    if (command == PROG_PAGE) {
        uint8_t at = is_flash() ? (uint8_t)(stk.address << 1) : 0;
        memory_read_page(stk.address >> 7, memory_work);
        for (uint16_t left = length(); left > 0 && !stk.is_broken; left--) {
            memory_work[at++] = take();
        }
    }
    return take() == SYNC_EOP;
}

void stk500_session(void)
{
    uint8_t command = GET_SYNC;
    uint8_t silent = 0;
    stk.is_entered = false;
    stk.is_broken = false;
    uart_put(INSYNC);
    uart_put(OK);
    while (command != LEAVE && silent < IDLE_SLICES && !stk.is_broken) {
        if (!uart_wait(SLICE_TICKS)) {
            silent++;
            continue;
        }
        command = uart_next();
        silent = 0;
        uint8_t count = arg_count(command);
        if (count == 0xFF) {
            break;
        }
        if (take_command(command, count)) {
            uart_put(INSYNC);
            uart_put(carry_out(command));
        } else {
            uart_put(NOSYNC);
        }
    }
}
