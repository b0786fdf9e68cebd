"""Tests of ``geometry/laws``."""
