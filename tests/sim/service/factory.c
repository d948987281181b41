/* SPDX-License-Identifier: MIT
 * factory.c - imitates the factory loader's page-write routine for test_boot_service.py. It starts the application at
 * once and has a routine at 0x1F238 with the calling convention of boot/ORIGINAL.md, section 7b. It does the worst that
 * the convention allows: it overwrites every register that need not be kept and uses eight bytes below Y. */
#include <avr/io.h>

static void __attribute__((naked, used, section(".vectors"))) start(void)
{
    asm volatile("clr r1\n\t"
                 "ldi r28, 0x48\n\tout 0x3D, r28\n\t" /* the stack pointer as the original leaves it: 0x0E48 */
                 "ldi r28, 0x0E\n\tout 0x3E, r28\n\t"
                 "jmp 0");
}

void factory_write_page(void);
void __attribute__((naked, used, externally_visible, section(".factory"))) factory_write_page(void)
{
    asm volatile(
        "ldi r20, 8\n"
        "1: st -Y, r20\n\tdec r20\n\tbrne 1b\n\tadiw r28, 8\n\t" /* the data stack */
        "push r26\n\tpush r27\n\t"
        "out %[rampz], r18\n\t"
        "movw r30, r16\n\tldi r26, 0x61\n\tldi r27, 0x0C\n\tldi r20, 128\n"
        "2: ld r0, X+\n\tld r1, X+\n\tldi r21, 0x01\n\tsts %[spmcsr], r21\n\tspm\n\t"
        "adiw r30, 2\n\tdec r20\n\tbrne 2b\n\t"
        "movw r30, r16\n\tldi r21, 0x03\n\tsts %[spmcsr], r21\n\tspm\n"
        "3: lds r21, %[spmcsr]\n\tsbrc r21, 0\n\trjmp 3b\n\t"
        "ldi r21, 0x05\n\tsts %[spmcsr], r21\n\tspm\n"
        "4: lds r21, %[spmcsr]\n\tsbrc r21, 0\n\trjmp 4b\n\t"
        "ldi r21, 0x11\n\tsts %[spmcsr], r21\n\tspm\n\t"
        "movw r30, r16\n\tldi r26, 0x61\n\tldi r27, 0x0C\n\tclr r20\n\tldi r16, 0\n\tldi r17, 1\n"
        "5: elpm r0, Z+\n\tld r1, X+\n\tcpse r0, r1\n\trjmp 6f\n\tdec r20\n\tbrne 5b\n\trjmp 7f\n"
        "6: ldi r16, 10\n\tldi r17, 0\n"
        "7: pop r27\n\tpop r26\n\t"
        "ldi r18, 0xEE\n\tmov r0, r18\n\tmov r1, r18\n\tmov r2, r18\n\tmov r3, r18\n\tmovw r18, r0\n\tmovw r20, r0\n\t"
        "movw r22, r0\n\tmovw r30, r0\n\tret"
        :
        : [spmcsr] "i"(_SFR_MEM_ADDR(SPMCSR)), [rampz] "I"(_SFR_IO_ADDR(RAMPZ)));
}
