"""Noncircular gears."""
