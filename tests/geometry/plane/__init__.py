"""Tests of ``geometry/plane``."""
