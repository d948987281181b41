/* SPDX-License-Identifier: MIT
 * compiler.h - the few compiler words this project uses. May be included anywhere. */
#ifndef COMPILER_H
#define COMPILER_H

/* The caller must look at the result. */
#define MUST_CHECK __attribute__((warn_unused_result))

/* Holds at compile time or the build fails. */
#define STATIC_ASSERT(condition, text) _Static_assert(condition, text)

/* Where -Os decides wrongly: a function of a few bytes that is called hundreds of times in a tick; one that is copied to
 * each of its callers and should not be. */
#define ALWAYS_INLINE static inline __attribute__((always_inline))
#define NOINLINE __attribute__((noinline))

/* The compiler forgets what it knows of a variable and keeps it in registers at this point. For loops whose cycles are
 * counted; say at each use what it gains. */
#define OPAQUE(variable) __asm__("" : "+r"(variable))

/* Defined in a header, one copy a program: a static function there is one copy a file that uses it. */
#define ONE_COPY __attribute__((weak))

#define ARRAY_COUNT(array) (sizeof(array) / sizeof((array)[0]))

#endif
