"""Tests of ``parts/cams/barrel_cam``."""
