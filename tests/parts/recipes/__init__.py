"""Tests of ``parts/recipes``."""
