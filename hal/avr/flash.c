/* SPDX-License-Identifier: MIT */
#include "flash.h"

#include <avr/io.h>
#include <avr/pgmspace.h>

uint32_t flash_addr(uint16_t page)
{
    return (uint32_t)page * FLASH_PAGE_BYTES;
}

/* ELPM Z+ reads a byte and increments all 24 bits of the address, including RAMPZ, so reads may cross 0x10000. 7 cycles per
 * byte. The loop copies two bytes at a time; an odd byte comes first. */
void flash_read(uint32_t addr, void *to, uint16_t bytes)
{
    if (bytes == 0) {
        return;
    }
    bytes--; /* the loop ends when the count falls below 0 */
    __asm__ volatile(
        "out %[rampz], %C[addr] \n\t"
        "movw r30, %A[addr] \n\t"
        "sbrs %A[count], 0 \n\t"
        "rjmp 2f \n"
        "1: elpm __tmp_reg__, Z+ \n\t"
        "st X+, __tmp_reg__ \n"
        "2: elpm __tmp_reg__, Z+ \n\t"
        "st X+, __tmp_reg__ \n\t"
        "subi %A[count], 2 \n\t"
        "sbci %B[count], 0 \n\t"
        "brcc 1b \n\t"
        : [count] "+d"(bytes), "+x"(to)
        : [addr] "r"(addr), [rampz] "I"(_SFR_IO_ADDR(RAMPZ))
        : "r30", "r31", "memory");
}

NOINLINE bool flash_equals(uint32_t addr, const void *data, uint16_t bytes)
{
    const uint8_t *p = data;
    while (bytes-- > 0) {
        if (pgm_read_byte_far(addr++) != *p++) {
            return false;
        }
    }
    return true;
}
