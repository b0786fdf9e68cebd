"""Tests of ``parts/gears/spur_gear``."""
