"""Pairs of involute gears: distances, limits and numbers of quality."""
