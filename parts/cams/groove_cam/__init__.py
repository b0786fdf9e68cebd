"""Groove cams and their pieces for the laser."""
