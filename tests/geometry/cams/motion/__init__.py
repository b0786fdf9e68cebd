"""Tests of ``geometry/cams/motion``."""
