/* SPDX-License-Identifier: MIT
 * The loader built on a PC has no interrupts. */
#ifndef LOADER_INTERRUPT_H
#define LOADER_INTERRUPT_H

static inline void cli(void)
{
}

static inline void sei(void)
{
}

#endif
