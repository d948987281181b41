/* SPDX-License-Identifier: MIT
 * page_service.h - finds out which program can write flash here, and implements the writing half of flash.h with it.
 *
 *   PAGE_SERVICE_OURS     our loader: call table at 0x1FFE0 (boot_api.h)
 *   PAGE_SERVICE_FACTORY  factory loader 1.31, identified by CRC and sum of its 8 KiB: its routine at 0x1F238
 *                         (boot/ORIGINAL.md, 7b)
 *   PAGE_SERVICE_MAILBOX  another loader: at the next start it may write a page left in EEPROM (7a).
 *                         flash_write returns FLASH_ERR_NO_WRITER; call page_service_post and restart
 *   PAGE_SERVICE_NONE     an empty boot section: nothing can write flash
 *
 * Main loop only. */
#ifndef PAGE_SERVICE_H
#define PAGE_SERVICE_H

#include "boot_call.h"
#include "flash.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum {
    PAGE_SERVICE_NONE = 0,
    PAGE_SERVICE_OURS,
    PAGE_SERVICE_FACTORY,
    PAGE_SERVICE_MAILBOX
} page_service_kind_t;

/* Identifies the loader and stores the result. Immediate with our loader, otherwise about 35 ms for the sums.
 * rx : the ring that takes the bytes of UART1 during a write, or NULL; must stay valid. */
page_service_kind_t page_service_init(const boot_rx_t *rx);

/* What page_service_init found. */
page_service_kind_t page_service_kind(void);

/* Leaves a motion page (512 bytes) in the EEPROM mailbox for the next start. Only bytes that differ are written,
 * 8.5 ms each: up to 4.4 s. Kicks the watchdog. The caller restarts afterwards.
 * true : the mailbox is complete; false : motion_page above 127, nothing was touched. */
MUST_CHECK bool page_service_post(uint8_t motion_page, const uint8_t data[512]);

/* What happened to the page in the mailbox. The first call clears it: later calls return PAGE_SERVICE_MAIL_NONE. */
typedef enum {
    PAGE_SERVICE_MAIL_NONE = 0, /* nothing was posted */
    PAGE_SERVICE_MAIL_WRITTEN,  /* the loader reports that it wrote the page: compare it */
    PAGE_SERVICE_MAIL_IGNORED   /* still there after a restart: this loader has no mailbox */
} page_service_mail_t;
page_service_mail_t page_service_mail(void);

#endif
