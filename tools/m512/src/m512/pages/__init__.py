# SPDX-License-Identifier: MIT
"""What `m512 pages` and `m512 diff` do with a motion image."""
