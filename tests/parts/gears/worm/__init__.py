"""Tests of ``parts/gears/worm``."""
