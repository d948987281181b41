# SPDX-License-Identifier: MIT
"""Motions in files: the page, the image, and every format that holds them."""
