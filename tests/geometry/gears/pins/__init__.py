"""Tests of ``geometry/gears/pins``."""
