"""Tests of ``geometry/gears/teeth``."""
