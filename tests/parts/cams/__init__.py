"""Tests of ``parts/cams``."""
