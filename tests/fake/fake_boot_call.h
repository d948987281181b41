/* SPDX-License-Identifier: MIT
 * fake_boot_call.h - a fake boot section for hal/boot_call.h and the reading half of hal/flash.h. Records the calls. */
#ifndef FAKE_BOOT_CALL_H
#define FAKE_BOOT_CALL_H

#include "boot_call.h"

/* Erased flash, no calls, every call returns BOOT_OK. */
void fake_boot_call_reset(void);

/* The 128 KiB that flash_read sees. */
uint8_t *fake_boot_call_flash(void);

/* Result of all further calls. */
void fake_boot_call_answer(uint8_t result);

/* The last call. */
typedef enum { FAKE_CALL_NONE, FAKE_CALL_OURS, FAKE_CALL_FACTORY } fake_call_t;
typedef struct {
    fake_call_t who;
    uint32_t addr;
    uint16_t bytes;
    uint8_t mode;
    const boot_rx_t *rx;
} fake_boot_call_t;
const fake_boot_call_t *fake_boot_call_last(void);

#endif
