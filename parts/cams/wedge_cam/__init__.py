"""Cams that slide."""
