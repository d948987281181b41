/* SPDX-License-Identifier: MIT
 * button.h - START, the one button that the loader asks, with its contact debounced. RAM: 3 bytes. */
#ifndef BUTTON_H
#define BUTTON_H

/* What START's contact says once it has stood still for 10 ms, as far as was looked; BUTTON_BOUNCING before. */
typedef enum { BUTTON_BOUNCING, BUTTON_UP, BUTTON_DOWN } button_t;
button_t button_look(void);

#endif
