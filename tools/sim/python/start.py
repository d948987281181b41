# SPDX-License-Identifier: MIT
"""Started by tools/sim/cm5sim: runs the command from the source tree, without installation."""

from cm5sim.command import main

main()
