/* SPDX-License-Identifier: MIT */
#include "fake_boot_call.h"

#include "flash.h"
#include "memory_map.h"
#include "trap.h"

#include <string.h>

static uint8_t flash[MEM_BOOT_END];
static fake_boot_call_t last;
static uint8_t answer;

void fake_boot_call_reset(void)
{
    memset(flash, 0xFF, sizeof flash);
    memset(&last, 0, sizeof last);
    answer = BOOT_OK;
}

uint8_t *fake_boot_call_flash(void)
{
    return flash;
}

void fake_boot_call_answer(uint8_t result)
{
    answer = result;
}

const fake_boot_call_t *fake_boot_call_last(void)
{
    return &last;
}

static uint8_t call(fake_call_t who, uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode, const boot_rx_t *rx)
{
    ASSERT(addr % 256 == 0 && addr < MEM_BOOT_START && bytes >= 2 && bytes <= 256 && data != NULL);
    last = (fake_boot_call_t){.who = who, .addr = addr, .bytes = bytes, .mode = mode, .rx = rx};
    return answer;
}

uint8_t boot_call_write(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode, const boot_rx_t *rx)
{
    return call(FAKE_CALL_OURS, addr, data, bytes, mode, rx);
}

uint8_t boot_call_factory(uint32_t addr, const uint8_t *data, uint16_t bytes, uint8_t mode)
{
    return call(FAKE_CALL_FACTORY, addr, data, bytes, mode, NULL);
}

void flash_read(uint32_t addr, void *to, uint16_t bytes)
{
    ASSERT(addr + bytes <= sizeof flash);
    memcpy(to, flash + addr, bytes);
}

bool flash_equals(uint32_t addr, const void *data, uint16_t bytes)
{
    ASSERT(addr + bytes <= sizeof flash);
    return memcmp(flash + addr, data, bytes) == 0;
}
