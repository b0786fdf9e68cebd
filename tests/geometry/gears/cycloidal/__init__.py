"""Cycloidal gears."""
