/* SPDX-License-Identifier: MIT
 * mul.h - the multiplications of the motion core, AVR version (host version: hal/host/mul.h). May be included anywhere.
 * In assembly, because gcc 5.4 calls its library for them: 45 and 110 cycles instead of 19 and 42, and more registers. In C,
 * a tick of the classic law exceeds its budget by 15 % (make_fall: 360 cycles per joint instead of 190), and planning a step
 * under the exact law takes twice its budget. */
#ifndef MUL_H
#define MUL_H

#include <stdint.h>
#include "compiler.h"

/* (a * b) >> 16 of a 32-bit product. */
ALWAYS_INLINE uint16_t mul_u16_high(uint16_t a, uint16_t b)
{
    uint16_t high;
    uint8_t carry, zero;
    __asm__("clr %[zero] \n\t"
            "mul %B[a], %B[b] \n\t"
            "movw %A[high], r0 \n\t"
            "mul %A[a], %A[b] \n\t"
            "mov %[carry], r1 \n\t"
            "mul %A[a], %B[b] \n\t"
            "add %[carry], r0 \n\t"
            "adc %A[high], r1 \n\t"
            "adc %B[high], %[zero] \n\t"
            "mul %B[a], %A[b] \n\t"
            "add %[carry], r0 \n\t"
            "adc %A[high], r1 \n\t"
            "adc %B[high], %[zero] \n\t"
            "clr r1 \n\t"
            : [high] "=&r"(high), [carry] "=&r"(carry), [zero] "=&r"(zero)
            : [a] "r"(a), [b] "r"(b));
    return high;
}

/* a * b, all 24 bits. */
ALWAYS_INLINE uint32_t mul_u16_u8(uint16_t a, uint8_t b)
{
    uint32_t product;
    __asm__("mul %A[a], %[b] \n\t"
            "movw %A[product], r0 \n\t"
            "clr %C[product] \n\t"
            "clr %D[product] \n\t"
            "mul %B[a], %[b] \n\t"
            "add %B[product], r0 \n\t"
            "adc %C[product], r1 \n\t"
            "clr r1 \n\t"
            : [product] "=&r"(product)
            : [a] "r"(a), [b] "r"(b));
    return product;
}

/* a * b, all 32 bits. */
ALWAYS_INLINE uint32_t mul_u16_u16(uint16_t a, uint16_t b)
{
    uint32_t product;
    uint8_t zero;
    __asm__("clr %[zero] \n\t"
            "mul %B[a], %B[b] \n\t"
            "movw %C[product], r0 \n\t"
            "mul %A[a], %A[b] \n\t"
            "movw %A[product], r0 \n\t"
            "mul %A[a], %B[b] \n\t"
            "add %B[product], r0 \n\t"
            "adc %C[product], r1 \n\t"
            "adc %D[product], %[zero] \n\t"
            "mul %B[a], %A[b] \n\t"
            "add %B[product], r0 \n\t"
            "adc %C[product], r1 \n\t"
            "adc %D[product], %[zero] \n\t"
            "clr r1 \n\t"
            : [product] "=&r"(product), [zero] "=&r"(zero)
            : [a] "r"(a), [b] "r"(b));
    return product;
}

/* (a * b) >> 16 of a 48-bit product. */
ALWAYS_INLINE uint32_t mul_u32_u16_shift16(uint32_t a, uint16_t b)
{
    uint32_t high;
    uint8_t carry, zero;
    __asm__("clr %[zero] \n\t"
            "mul %B[a], %B[b] \n\t"
            "movw %A[high], r0 \n\t"
            "mul %D[a], %B[b] \n\t"
            "movw %C[high], r0 \n\t"
            "mul %A[a], %A[b] \n\t"
            "mov %[carry], r1 \n\t"
            "mul %A[a], %B[b] \n\t"
            "add %[carry], r0 \n\t"
            "adc %A[high], r1 \n\t"
            "adc %B[high], %[zero] \n\t"
            "adc %C[high], %[zero] \n\t"
            "adc %D[high], %[zero] \n\t"
            "mul %B[a], %A[b] \n\t"
            "add %[carry], r0 \n\t"
            "adc %A[high], r1 \n\t"
            "adc %B[high], %[zero] \n\t"
            "adc %C[high], %[zero] \n\t"
            "adc %D[high], %[zero] \n\t"
            "mul %C[a], %A[b] \n\t"
            "add %A[high], r0 \n\t"
            "adc %B[high], r1 \n\t"
            "adc %C[high], %[zero] \n\t"
            "adc %D[high], %[zero] \n\t"
            "mul %C[a], %B[b] \n\t"
            "add %B[high], r0 \n\t"
            "adc %C[high], r1 \n\t"
            "adc %D[high], %[zero] \n\t"
            "mul %D[a], %A[b] \n\t"
            "add %B[high], r0 \n\t"
            "adc %C[high], r1 \n\t"
            "adc %D[high], %[zero] \n\t"
            "clr r1 \n\t"
            : [high] "=&r"(high), [carry] "=&r"(carry), [zero] "=&r"(zero)
            : [a] "r"(a), [b] "r"(b));
    return high;
}

#endif
