/* SPDX-License-Identifier: MIT
 * mul.h - the multiplications that the motion core lives on, AVR version (host version: tests/fake/mul.h). May be
 * included anywhere. In assembler because gcc 5.4 calls its library for them: 45 and 110 cycles instead of 19 and 42, and
 * the registers that the call needs besides. */
#ifndef MUL_H
#define MUL_H

#include <stdint.h>

/* (a * b) >> 16 of a 32-bit product. */
static inline uint16_t mul_u16_high(uint16_t a, uint16_t b)
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

/* (a * b) >> 8 of a 16-bit product, whose upper bits are lost. gcc 5.4 shifts and adds, for 14 cycles instead of 8. */
static inline uint8_t mul_u16_u8_shift8(uint16_t a, uint8_t b)
{
    uint8_t high;
    __asm__("mul %A[a], %[b] \n\t"
            "mov %[high], r1 \n\t"
            "mul %B[a], %[b] \n\t"
            "add %[high], r0 \n\t"
            "clr r1 \n\t"
            : [high] "=&r"(high)
            : [a] "r"(a), [b] "r"(b));
    return high;
}

/* (a * b) >> 8. */
static inline uint8_t mul_u8_high(uint8_t a, uint8_t b)
{
    uint8_t high;
    __asm__("mul %[a], %[b] \n\t"
            "mov %[high], r1 \n\t"
            "clr r1 \n\t"
            : [high] "=r"(high)
            : [a] "r"(a), [b] "r"(b));
    return high;
}

/* (a * b) >> 16 of a product below 2^40, of which 24 bits are returned; b below 2^24. */
static inline uint32_t mul_u16_u24_shift16(uint16_t a, uint32_t b)
{
    uint32_t high;
    uint8_t carry;
    __asm__("clr %C[high] \n\t"
            "clr %D[high] \n\t"
            "mul %A[a], %A[b] \n\t"
            "mov %[carry], r1 \n\t"
            "mul %B[a], %B[b] \n\t"
            "movw %A[high], r0 \n\t"
            "mul %A[a], %B[b] \n\t"
            "add %[carry], r0 \n\t"
            "adc %A[high], r1 \n\t"
            "adc %B[high], %D[high] \n\t"
            "mul %B[a], %A[b] \n\t"
            "add %[carry], r0 \n\t"
            "adc %A[high], r1 \n\t"
            "adc %B[high], %D[high] \n\t"
            "mul %A[a], %C[b] \n\t"
            "add %A[high], r0 \n\t"
            "adc %B[high], r1 \n\t"
            "adc %C[high], %D[high] \n\t"
            "mul %B[a], %C[b] \n\t"
            "add %B[high], r0 \n\t"
            "adc %C[high], r1 \n\t"
            "clr r1 \n\t"
            : [high] "=&r"(high), [carry] "=&r"(carry)
            : [a] "r"(a), [b] "r"(b));
    return high;
}

/* a * b, all 32 bits. */
static inline uint32_t mul_u16_u16(uint16_t a, uint16_t b)
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
static inline uint32_t mul_u32_u16_shift16(uint32_t a, uint16_t b)
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

/* (a * b) >> 32, 16 bits of it; a below 2^24. */
static inline uint16_t mul_u24_u32_shift32(uint32_t a, uint32_t b)
{
    uint16_t high;
    uint8_t low, mid, top, zero;
    /* low, mid, top: bytes 1 to 3 of the sum. Each adds what carries into the bytes above. */
    __asm__("clr %[zero] \n\t"
            "mul %A[a], %A[b] \n\t"
            "mov %[low], r1 \n\t"
            "mul %B[a], %B[b] \n\t"
            "mov %[mid], r0 \n\t"
            "mov %[top], r1 \n\t"
            "mul %B[a], %D[b] \n\t"
            "movw %A[high], r0 \n\t"
            "mul %A[a], %B[b] \n\t"
            "add %[low], r0 \n\t"
            "adc %[mid], r1 \n\t"
            "adc %[top], %[zero] \n\t"
            "adc %A[high], %[zero] \n\t"
            "adc %B[high], %[zero] \n\t"
            "mul %B[a], %A[b] \n\t"
            "add %[low], r0 \n\t"
            "adc %[mid], r1 \n\t"
            "adc %[top], %[zero] \n\t"
            "adc %A[high], %[zero] \n\t"
            "adc %B[high], %[zero] \n\t"
            "mul %A[a], %C[b] \n\t"
            "add %[mid], r0 \n\t"
            "adc %[top], r1 \n\t"
            "adc %A[high], %[zero] \n\t"
            "adc %B[high], %[zero] \n\t"
            "mul %A[a], %D[b] \n\t"
            "add %[top], r0 \n\t"
            "adc %A[high], r1 \n\t"
            "adc %B[high], %[zero] \n\t"
            "mul %B[a], %C[b] \n\t"
            "add %[top], r0 \n\t"
            "adc %A[high], r1 \n\t"
            "adc %B[high], %[zero] \n\t"
            "mul %C[a], %A[b] \n\t"
            "add %[mid], r0 \n\t"
            "adc %[top], r1 \n\t"
            "adc %A[high], %[zero] \n\t"
            "adc %B[high], %[zero] \n\t"
            "mul %C[a], %B[b] \n\t"
            "add %[top], r0 \n\t"
            "adc %A[high], r1 \n\t"
            "adc %B[high], %[zero] \n\t"
            "mul %C[a], %C[b] \n\t"
            "add %A[high], r0 \n\t"
            "adc %B[high], r1 \n\t"
            "mul %C[a], %D[b] \n\t"
            "add %B[high], r0 \n\t"
            "clr r1 \n\t"
            : [high] "=&r"(high), [low] "=&r"(low), [mid] "=&r"(mid), [top] "=&r"(top), [zero] "=&r"(zero)
            : [a] "r"(a), [b] "r"(b));
    return high;
}

/* value >> 4, unrolled: gcc makes a loop of it, 27 cycles instead of 16. */
static inline uint32_t shift_u32_right4(uint32_t value)
{
#define HALVE "lsr %D[v] \n\tror %C[v] \n\tror %B[v] \n\tror %A[v] \n\t"
    __asm__(HALVE HALVE HALVE HALVE : [v] "+r"(value));
#undef HALVE
    return value;
}

#endif
