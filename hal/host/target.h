/* SPDX-License-Identifier: MIT
 * target.h - a PC's values where they differ from the ATmega128's (hal/avr/target.h). May be included anywhere. */
#ifndef TARGET_H
#define TARGET_H

/* Motion pages: as many as a link can address. They are above the chip's flash, because at the chip's address half of them
 * would reach into its boot section and beyond. */
#define TARGET_MOTION_PAGES 256u
#define TARGET_MOTION_START 0x20000
#define TARGET_FLASH_END 0x40000

/* Time on the servo bus, in half microseconds: through an adapter an answer may take 50 ms, more than 16 bits hold. */
#define TARGET_BUS_TIME uint32_t
#define TARGET_BUS_SPAN int32_t

/* A servo counts as silent when the weights of its failed health polls add up to the limit: three without an answer. A
 * damaged answer weighs less: after a delay of the program or the adapter, goals and an answer collide on the line. */
#define TARGET_POLL_LIMIT 12u
#define TARGET_POLL_SILENT 4u
#define TARGET_POLL_GARBLED 1u

#endif
