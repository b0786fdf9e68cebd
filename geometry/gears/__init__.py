"""Gears cut by generation: dimensions, limits and exact tooth outlines."""
