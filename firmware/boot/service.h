/* SPDX-License-Identifier: MIT
 * service.h - the page-write service behind the call table, and receiving while interrupts are off.
 * Runs with an application's stack and RAM, so it must not use .data, .bss or PROGMEM strings. */
#ifndef SERVICE_H
#define SERVICE_H

#include "boot_api.h"

#include <stdbool.h>
#include <stdint.h>

/* The entry at BOOT_API_WRITE_PAGE; contract in boot_api.h. */
boot_write_page_t boot_write_page;

/* Moves a received byte, if any, from UART1 into the ring. Does nothing if rx is NULL. */
void service_poll(const boot_rx_t *rx);

#endif
