"""Tests of ``geometry/gears/pictures``."""
