/* SPDX-License-Identifier: MIT
 * imported_body.h - a body supplied by the page behind the seam of servo_body.h: the module's two imports, look and
 * step of the module "body". Both get a pointer to the shafts (four doubles each: ID, torque, angle, speed) and their
 * number. */
#ifndef IMPORTED_BODY_H
#define IMPORTED_BODY_H

#include "servo_body.h"

/* Never NULL. One per module. */
const servo_body_t *imported_body(void);

#endif
