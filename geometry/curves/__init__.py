"""Exact plane curves, their images, parallels and bounds."""
