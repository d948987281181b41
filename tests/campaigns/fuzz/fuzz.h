/* SPDX-License-Identifier: MIT
 * fuzz.h - what the harnesses share. Each harness is one file. It turns any bytes into calls of one module and
 * ASSERTs (trap.h) what must always hold. Linked with libFuzzer (clang) it searches; linked with replay.c (any
 * compiler) it repeats a corpus. This header depends on no module. */
#ifndef FUZZ_H
#define FUZZ_H

#include <stddef.h>
#include <stdint.h>

/* The harness's function, named by libFuzzer. Returns 0. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Reads an input from its start; after its end all bytes are 0. */
typedef struct {
    const uint8_t *at, *end;
} fuzz_t;

static inline size_t fuzz_left(const fuzz_t *fuzz)
{
    return (size_t)(fuzz->end - fuzz->at);
}

static inline uint8_t fuzz_byte(fuzz_t *fuzz)
{
    return fuzz->at < fuzz->end ? *fuzz->at++ : 0;
}

static inline uint16_t fuzz_word(fuzz_t *fuzz)
{
    const uint8_t low = fuzz_byte(fuzz);
    return (uint16_t)(low | fuzz_byte(fuzz) << 8);
}

static inline void fuzz_bytes(fuzz_t *fuzz, uint8_t *to, size_t count)
{
    while (count-- > 0) {
        *to++ = fuzz_byte(fuzz);
    }
}

#endif
