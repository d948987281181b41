/* SPDX-License-Identifier: MIT */
#include "boot_call.h"

#include "compiler.h"
#include "flash.h"

#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/io.h>
#include <string.h>
#include <util/atomic.h>

/* Word address of a routine as a C function. */
#define ROUTINE(type, byte_addr) ((type *)(uint16_t)((byte_addr) / 2))

uint8_t boot_call_write(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode, const boot_rx_t *rx)
{
    return (uint8_t)ROUTINE(boot_write_page_t, BOOT_API_WRITE_PAGE)(addr, data, bytes, mode, rx);
}

#define FACTORY_ENTRY 0x1F238
#define FACTORY_STACK_BYTES 8
#define FACTORY_BUFFER ((uint8_t *)MEM_FACTORY_BUFFER)

/* The routine preserves r4-r15 and r24-r29. Whether it preserves r2 and r3 is unknown, so they are saved here. */
static uint8_t call_factory(uint32_t addr)
{
    uint8_t data_stack[FACTORY_STACK_BYTES];
    uint8_t *stack_end = data_stack + sizeof data_stack;
    uint8_t rampz = RAMPZ;
    register uint32_t at asm("r16") = addr;
    asm volatile("push r2\n\tpush r3\n\tpush r28\n\tpush r29\n\t"
                 "movw r28, r30\n\t"
                 "call %[entry]\n\t"
                 "pop r29\n\tpop r28\n\tpop r3\n\tpop r2\n\t"
                 "clr r1"
                 : "+r"(at), "+z"(stack_end)
                 : [entry] "i"(FACTORY_ENTRY)
                 : "r0", "r20", "r21", "r22", "r23", "memory");
    RAMPZ = rampz;
    return (uint8_t)(at >> 8) == 1 ? BOOT_OK : BOOT_ERR_VERIFY;
}

/* Fills the buffer for the routine. `data` may overlap the buffer: it is moved first and not read again. */
static void fill_factory_buffer(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode)
{
    memmove(FACTORY_BUFFER, data, bytes);
    if (mode == BOOT_MODE_WRITE) {
        memset(FACTORY_BUFFER + bytes, 0xFF, MEM_FACTORY_BUFFER_BYTES - bytes);
        return;
    }
    for (uint16_t i = 0; i < MEM_FACTORY_BUFFER_BYTES; i++) {
        uint8_t old;
        flash_read(addr + i, &old, 1);
        FACTORY_BUFFER[i] = i < bytes ? (FACTORY_BUFFER[i] & old) : old;
    }
}

NOINLINE uint8_t boot_call_factory(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode)
{
    uint8_t saved[MEM_FACTORY_BUFFER_BYTES];
    uint8_t result = BOOT_OK;

    if ((uint8_t)addr != 0 || addr >= MEM_BOOT_START || bytes > MEM_FACTORY_BUFFER_BYTES ||
        SP < MEM_FACTORY_BUFFER + MEM_FACTORY_BUFFER_BYTES + FACTORY_STACK_BYTES + 32) {
        return BOOT_ERR_RANGE;
    }
    eeprom_busy_wait();
    asm volatile("wdr");
    ATOMIC_BLOCK(ATOMIC_RESTORESTATE)
    {
        memcpy(saved, FACTORY_BUFFER, sizeof saved);
        fill_factory_buffer(addr, data, bytes, mode);
        result = call_factory(addr);
        memcpy(FACTORY_BUFFER, saved, sizeof saved);
    }
    return result;
}
