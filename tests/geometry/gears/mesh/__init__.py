"""Tests of ``geometry/gears/mesh``."""
