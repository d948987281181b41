/* SPDX-License-Identifier: MIT
 * page_service.h - finds who can write flash here, and is the writing half of flash.h for applications.
 *
 *   PAGE_SERVICE_OURS     our loader: call table at 0x1FFE0 (boot_api.h)
 *   PAGE_SERVICE_FACTORY  factory loader 1.31, known by two CRCs and the sum of its 8 KiB: its routine at 0x1F238
 *                         (bootloader-original.md, 7b)
 *   PAGE_SERVICE_MAILBOX  some other loader: a page left in EEPROM is hoped to be written at the next start (7a).
 *                         flash_write answers FLASH_ERR_NO_WRITER; use page_service_post and reset
 *   PAGE_SERVICE_NONE     an empty boot section: nobody
 *
 * One file-static struct, 3 bytes of RAM. Main loop only. */
#ifndef PAGE_SERVICE_H
#define PAGE_SERVICE_H

#include "hal/boot_call.h"
#include "hal/flash.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum {
    PAGE_SERVICE_NONE = 0,
    PAGE_SERVICE_OURS,
    PAGE_SERVICE_FACTORY,
    PAGE_SERVICE_MAILBOX
} page_service_kind_t;

/* Looks at the boot section (about 35 ms where it has to sum it up, else at once) and remembers what it found.
 * rx : the ring that is to take the bytes of UART1 during a write, or NULL; must stay valid. */
page_service_kind_t page_service_init(const boot_rx_t *rx);

/* What page_service_init found. */
page_service_kind_t page_service_kind(void);

/* Leaves a motion page (512 bytes) in the EEPROM mailbox for the next start. Only bytes that differ are written,
 * 8.5 ms each: up to 4.4 s, watchdog kicked. The caller resets afterwards.
 * true : the mailbox is complete; false : motion_page above 127, nothing was touched. */
MUST_CHECK bool page_service_post(uint8_t motion_page, const uint8_t data[512]);

/* What became of the last mailbox; asks once, then the answer is gone. */
typedef enum {
    PAGE_SERVICE_MAIL_NONE = 0, /* nothing was posted */
    PAGE_SERVICE_MAIL_WRITTEN,  /* the loader took it: compare the page before you believe it */
    PAGE_SERVICE_MAIL_IGNORED   /* still there after a restart: this loader does not know the mailbox */
} page_service_mail_t;
page_service_mail_t page_service_mail(void);

#endif
