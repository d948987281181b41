# SPDX-License-Identifier: MIT
"""A board on a line: ports, loaders, transfers, backups, requests, the simulator."""
