"""Tests of ``geometry/solids``."""
