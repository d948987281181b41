/* SPDX-License-Identifier: MIT
 * compiler.h - the compiler's extensions that this project uses. May be included anywhere. */
#ifndef COMPILER_H
#define COMPILER_H

/* The caller must look at the result. */
#define MUST_CHECK __attribute__((warn_unused_result))

/* Fails the build unless `condition` is true. */
#define STATIC_ASSERT(condition, text) _Static_assert(condition, text)

/* For the functions that -Os judges wrongly. ALWAYS_INLINE: a few instructions, called hundreds of times in a tick.
 * NOINLINE: a large function that gcc would copy into each of its callers. */
#define ALWAYS_INLINE static inline __attribute__((always_inline))
#define NOINLINE __attribute__((noinline))

/* Makes the compiler forget what it knows about a variable and keep it in registers at this point. For loops whose cycles
 * are counted; say at each use what it gains. */
#define OPAQUE(variable) __asm__("" : "+r"(variable))

/* For a function defined in a header: one copy in a program. A static one would be copied into every file that uses it. */
#define ONE_COPY __attribute__((weak))

#define ARRAY_COUNT(array) (sizeof(array) / sizeof((array)[0]))

#endif
