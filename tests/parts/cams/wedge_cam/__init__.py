"""Tests of ``parts/cams/wedge_cam``."""
