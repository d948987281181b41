# SPDX-License-Identifier: MIT
"""What tools/sim/cm5sim starts: the command from the source tree, where it need not be installed."""

from cm5sim.command import main

main()
