"""Kernel-free mathematics of higher pairs: exact plane curves, gears, and their approximation."""
