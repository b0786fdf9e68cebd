"""Tests of ``geometry/cams/barrel``."""
