/* SPDX-License-Identifier: MIT
 * button.h - START, the only button that the loader uses, debounced. */
#ifndef BUTTON_H
#define BUTTON_H

/* The state of START once its contact has been stable for 10 ms; BUTTON_BOUNCING before. Each call samples the contact. */
typedef enum { BUTTON_BOUNCING, BUTTON_UP, BUTTON_DOWN } button_t;
button_t button_look(void);

#endif
