/* SPDX-License-Identifier: MIT
 * target.h - the numbers in which a PC differs from the ATmega128 (hal/avr/target.h). May be included anywhere. */
#ifndef TARGET_H
#define TARGET_H

/* Motion pages: all that a link can name. They are above what the chip has, because half of them would
 * reach into its boot section. */
#define TARGET_MOTION_PAGES 256u
#define TARGET_MOTION_START 0x20000
#define TARGET_FLASH_END 0x40000

/* Time on the servo bus, in half microseconds: through an adapter an answer may take 50 ms, more than 16 bits hold. */
#define TARGET_BUS_TIME uint32_t
#define TARGET_BUS_SPAN int32_t

/* A servo counts as silent when its failed health polls weigh so much: three without an answer. A damaged answer weighs
 * little: when this program or the adapter is held up, goals and an answer meet on the line. */
#define TARGET_POLL_LIMIT 12u
#define TARGET_POLL_SILENT 4u
#define TARGET_POLL_GARBLED 1u

#endif
