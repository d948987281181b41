/* SPDX-License-Identifier: MIT
 * unity_config.h - Unity on the ATmega128: 16-bit int, no floats, output on UART1.
 * A test file's own main becomes target_tests; target_main.c calls it. */
#ifndef UNITY_CONFIG_H
#define UNITY_CONFIG_H

#define UNITY_INT_WIDTH 16
#define UNITY_LONG_WIDTH 32
#define UNITY_POINTER_WIDTH 16
/* With AVR defined, Unity puts its strings into flash but reads them as RAM. */
#undef AVR

#define UNITY_EXCLUDE_FLOAT
#define UNITY_EXCLUDE_DOUBLE
#define UNITY_EXCLUDE_SETJMP_H

void target_put(char character);
int target_tests(void);
#define UNITY_OUTPUT_CHAR(character) target_put((char)(character))

#ifndef TARGET_MAIN
#define main target_tests
#endif

#endif
