"""Tests of ``geometry/base``."""
