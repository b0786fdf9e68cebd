"""Tests of ``geometry/gears/pairs``."""
