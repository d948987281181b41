/* SPDX-License-Identifier: MIT
 * page_edit.h - mirror images of positions. Pure; no RAM. VisualEditor's WebAssembly links it too. */
#ifndef PAGE_EDIT_H
#define PAGE_EDIT_H

#include <stdint.h>

/* The position mirrored for the joint on the other side: the same distance from that joint's neutral position, in the other
 * direction, limited to 0..PAGE_POS_MAX. neutral_sum: sum of both neutral positions, 2 * PAGE_POS_MIDDLE unless known. */
uint16_t page_edit_mirrored(uint16_t pos, uint16_t neutral_sum);

#endif
