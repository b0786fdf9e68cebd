"""Cylindrical cams: their walls, bodies and developments."""
