/* SPDX-License-Identifier: MIT
 * compiler.h - the few compiler words this project uses. May be included anywhere. */
#ifndef COMPILER_H
#define COMPILER_H

/* The caller must look at the result. */
#define MUST_CHECK __attribute__((warn_unused_result))

/* Holds at compile time or the build fails. */
#define STATIC_ASSERT(condition, text) _Static_assert(condition, text)

/* Where -Os decides wrongly: a few bytes called hundreds of times a tick; a helper that must not be copied. */
#define ALWAYS_INLINE static inline __attribute__((always_inline))
#define NOINLINE __attribute__((noinline))

/* Makes the compiler forget what a pointer points to. In an image with a single instance -flto puts its address into every
 * access (4 bytes on the AVR); by pointer the first 63 bytes of a struct are 2 bytes away. */
#define OPAQUE(pointer) __asm__("" : "+r"(pointer))
/* Of a number: it is known and in its registers here, whatever the optimizer would rather do. In loops that are counted in
 * cycles: gcc 5.4 splits loads from their pointers' steps, counters from their loops and bits over four registers. */

/* Defined in a header, one copy a program: a static function there is one copy a file that uses it. */
#define ONE_COPY __attribute__((weak))

#define ARRAY_COUNT(array) (sizeof(array) / sizeof((array)[0]))

#endif
