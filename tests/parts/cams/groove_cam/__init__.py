"""Tests of ``parts/cams/groove_cam``."""
