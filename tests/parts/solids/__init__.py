"""Tests of ``parts/solids``."""
