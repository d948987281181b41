/* SPDX-License-Identifier: MIT
 * machine_page_none.c - Play has no page in RAM: the requests for it (machine_page.c) are refused. */
#include "machine_parts.h"

#include "text.h"

static uint8_t refuse(void)
{
    return machine_says(MACHINE_ERR_IMAGE, TEXT_P("Not in this image"));
}

uint8_t machine_do_open(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    return refuse();
}

uint8_t machine_do_data(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    return refuse();
}

uint8_t machine_do_crc(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    return refuse();
}

uint8_t machine_do_save(void *context, const shell_args_t *args)
{
    (void)context;
    (void)args;
    return refuse();
}
