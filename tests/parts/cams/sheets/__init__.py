"""Tests of ``parts/cams/sheets``."""
