"""Worm wheels."""
