"""Tests of ``parts/drawing``."""
