/* SPDX-License-Identifier: MIT
 * compiler.h - the compiler's extensions that this project uses. May be included anywhere. */
#ifndef COMPILER_H
#define COMPILER_H

/* The caller must use the result. */
#define MUST_CHECK __attribute__((warn_unused_result))

/* Fails the build unless `condition` is true. */
#define STATIC_ASSERT(condition, text) _Static_assert(condition, text)

/* For functions that -Os inlines badly. ALWAYS_INLINE: a few instructions, called hundreds of times per tick. NOINLINE:
 * inlined copies would take 200 bytes or more, or bytes that Edit does not have, or keep bytes on the stack of the main
 * loop. */
#define ALWAYS_INLINE static inline __attribute__((always_inline))
#define NOINLINE __attribute__((noinline))

/* For a function defined in a header: one copy per program. A static one would be copied into every file that uses it. */
#define ONE_COPY __attribute__((weak))

#define ARRAY_COUNT(array) (sizeof(array) / sizeof((array)[0]))

#endif
