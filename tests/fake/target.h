/* SPDX-License-Identifier: MIT
 * target.h - gives unit tests the constants of the board. */
#include "../../hal/avr/target.h"
