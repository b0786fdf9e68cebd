"""Tests of ``geometry/gears/shifts``."""
