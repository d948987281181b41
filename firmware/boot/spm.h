/* SPDX-License-Identifier: MIT
 * spm.h - the four uses of the SPM instruction, in this file only. Before a call: RAMPZ selects the 64 KiB half, interrupts
 * are off, no EEPROM write is pending. addr is a byte address in that half; for all but spm_fill and spm_read, a page
 * address. Touches no RAM. Inlined: an erase is three instructions.
 * Assembly, because SPM must follow the store to SPMCSR within four cycles, with address and data in Z and r1:r0. */
#ifndef SPM_H
#define SPM_H

#include <avr/io.h>
#include <stdbool.h>
#include <stdint.h>

static inline void spm_command(uint16_t addr, uint8_t command)
{
    asm volatile("sts %[spmcsr], %[command]\n\t"
                 "spm"
                 :
                 : [spmcsr] "i"(_SFR_MEM_ADDR(SPMCSR)), [command] "r"(command), "z"(addr)
                 : "memory");
}

/* Puts one word into the page buffer. */
static inline void spm_fill(uint16_t addr, uint16_t word)
{
    asm volatile("movw r0, %[word]\n\t"
                 "sts %[spmcsr], %[command]\n\t"
                 "spm\n\t"
                 "clr r1"
                 :
                 : [spmcsr] "i"(_SFR_MEM_ADDR(SPMCSR)), [command] "r"((uint8_t)(1 << SPMEN)), "z"(addr), [word] "r"(word)
                 : "r0", "memory");
}

/* Start to erase a page or to write the page buffer: 4.5 ms, until spm_is_busy returns false. */
static inline void spm_erase(uint16_t addr)
{
    spm_command(addr, 1 << PGERS | 1 << SPMEN);
}

static inline void spm_write(uint16_t addr)
{
    spm_command(addr, 1 << PGWRT | 1 << SPMEN);
}

static inline bool spm_is_busy(void)
{
    return (SPMCSR & 1 << SPMEN) != 0;
}

/* Makes the flash below 0x1E000 readable again and clears the page buffer. */
static inline void spm_release(void)
{
    spm_command(0, 1 << RWWSRE | 1 << SPMEN);
}

/* One byte of flash. */
static inline uint8_t spm_read(uint16_t addr)
{
    uint8_t byte;
    asm volatile("elpm %[byte], Z" : [byte] "=r"(byte) : "z"(addr));
    return byte;
}

#endif
