"""Flat bodies of lines and arcs."""
