# SPDX-License-Identifier: MIT
"""What strange boards say, for foreign-boards.test.ts: two hundred talks of boards that are none of ours, made by m512's own recipe
(tests/campaigns/noise.py); the same every time. A line each, base64."""

import base64

from hypothesis import HealthCheck, given, settings

from tests.campaigns.noise import pieces


@settings(max_examples=200, derandomize=True, database=None, deadline=None, suppress_health_check=list(HealthCheck))
@given(pieces())
def talks(data):
    print(base64.b64encode(data).decode())


talks()
