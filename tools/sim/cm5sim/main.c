/* SPDX-License-Identifier: MIT */
#include <stddef.h>

#include "cm5sim.h"

int main(int argc, char **argv)
{
    return cm5sim_run(argc, argv, NULL);
}
