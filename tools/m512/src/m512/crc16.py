# SPDX-License-Identifier: MIT
"""CRC-16/IBM-3740: polynomial 0x1021, start 0xFFFF; "123456789" gives 0x29B1. The same as firmware/common/crc16.h."""

import binascii


def crc16(data: bytes, start: int = 0xFFFF) -> int:
    return binascii.crc_hqx(data, start)
