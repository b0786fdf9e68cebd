"""Tests of ``geometry/gears/planetary``."""
