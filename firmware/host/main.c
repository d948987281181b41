/* SPDX-License-Identifier: MIT
 * main.c - start of Play and Edit on a PC: options, the computer's ports and files, then program.c. */
#include "program.h"

#include "hal/host/pc/pc.h"

#include "requests.h"
#include <string.h>

int main(int argc, char **argv)
{
    pc_read_options(argc, argv);
    pc_options.has_edits = strcmp(requests_image.name_P, "edit") == 0;
    pc_open();
    return program_start();
}
