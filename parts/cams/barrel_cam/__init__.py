"""Cylindrical cams."""
