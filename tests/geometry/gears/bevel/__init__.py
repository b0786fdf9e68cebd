"""Bevel gears."""
