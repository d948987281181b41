/* SPDX-License-Identifier: MIT
 * target.h - the ATmega128's values where they differ from a PC's (hal/host/target.h). May be included anywhere. */
#ifndef TARGET_H
#define TARGET_H

/* Number of motion pages, address of the first one; an application may write below TARGET_FLASH_END (memory_map.h). */
#define TARGET_MOTION_PAGES 128u
#define TARGET_MOTION_START MEM_MOTION_START
#define TARGET_FLASH_END MEM_BOOT_START

/* Time on the servo bus, in half microseconds: answers arrive within 1 ms, far below the 32 ms of 16 bits. */
#define TARGET_BUS_TIME uint16_t
#define TARGET_BUS_SPAN int16_t

/* A servo counts as silent when the weights of its failed health polls add up to the limit: three of either kind. */
#define TARGET_POLL_LIMIT 3u
#define TARGET_POLL_SILENT 1u    /* no answer */
#define TARGET_POLL_GARBLED 1u   /* a damaged answer */

#endif
