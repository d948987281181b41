/* SPDX-License-Identifier: MIT
 * main.c - how Play and Edit begin on a PC: options, the computer's ports and files, then program.c. */
#include "program.h"

#include "hal/host/pc/pc.h"

int main(int argc, char **argv)
{
    pc_read_options(argc, argv);
    pc_open();
    return program_start();
}
