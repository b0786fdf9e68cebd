"""Tests of ``parts/gears``."""
