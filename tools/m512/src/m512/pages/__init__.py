# SPDX-License-Identifier: MIT
"""The operations of `m512 pages` and `m512 diff` on a motion image."""
