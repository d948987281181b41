/* SPDX-License-Identifier: MIT */
#include "imported_body.h"

#include <stddef.h>

__attribute__((import_module("body"), import_name("look"))) void body_look(servo_shaft_t *shafts, int count);
__attribute__((import_module("body"), import_name("step"))) void body_step(servo_shaft_t *shafts, int count);

static void look(void *context, servo_shaft_t *shafts, int count)
{
    (void)context;
    body_look(shafts, count);
}

static void step(void *context, servo_shaft_t *shafts, int count)
{
    (void)context;
    body_step(shafts, count);
}

const servo_body_t *imported_body(void)
{
    static const servo_body_t body = { .context = NULL, .look = look, .step = step };
    return &body;
}
