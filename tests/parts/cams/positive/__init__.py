"""Tests of ``parts/cams/positive``."""
