# SPDX-License-Identifier: MIT
"""Play and Edit as programs of this computer."""
