"""Tests of ``geometry/approximation``."""
