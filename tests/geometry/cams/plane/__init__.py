"""Tests of ``geometry/cams/plane``."""
