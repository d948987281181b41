# SPDX-License-Identifier: MIT
"""Intel HEX files for the tests, written by a third-party library."""

from intelhex import IntelHex


def hex_file(path, *pieces):
    """Writes (address, data) pieces to a file and returns its path."""
    file = IntelHex()
    for address, data in pieces:
        file.frombytes(data, offset=address)
    file.write_hex_file(str(path))
    return path
