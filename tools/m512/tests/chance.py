# SPDX-License-Identifier: MIT
"""Hypothesis settings for these tests: the same examples in every run, and no deadline, because a busy PC is slow."""

from hypothesis import HealthCheck, given, settings

__all__ = ["given", "settings"]

settings.register_profile(
    "m512", derandomize=True, database=None, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture]
)
settings.load_profile("m512")
