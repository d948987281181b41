/* SPDX-License-Identifier: MIT
 * target.h - unit tests have the numbers of the board. */
#include "../../hal/avr/target.h"
