"""Tests of ``geometry/gears/noncircular``."""
