/* SPDX-License-Identifier: MIT
 * target.h - the numbers in which the ATmega128 differs from a PC (hal/host/target.h). May be included anywhere. */
#ifndef TARGET_H
#define TARGET_H

/* Motion pages, and where the first one is in flash; an application may write below TARGET_FLASH_END (memory_map.h). */
#define TARGET_MOTION_PAGES 128u
#define TARGET_MOTION_START MEM_MOTION_START
#define TARGET_FLASH_END MEM_BOOT_START

/* Time on the servo bus, in half microseconds: an answer is there within 1 ms, far below the 32 ms of 16 bits. */
#define TARGET_BUS_TIME uint16_t
#define TARGET_BUS_SPAN int16_t

/* A servo counts as silent when its failed health polls weigh so much: three of either kind. */
#define TARGET_POLL_LIMIT 3u
#define TARGET_POLL_SILENT 1u    /* no answer */
#define TARGET_POLL_GARBLED 1u   /* an answer that was damaged */

#endif
