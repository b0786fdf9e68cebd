"""Tests of cams."""
