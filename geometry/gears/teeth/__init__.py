"""Involute teeth: racks, cutters, gears, rings, their outlines, limits and measures."""
