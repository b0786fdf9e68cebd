"""Tests of ``parts/cams/coupler_cam``."""
