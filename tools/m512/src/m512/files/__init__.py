# SPDX-License-Identifier: MIT
"""Motion files: the page, the image, and all file formats."""
