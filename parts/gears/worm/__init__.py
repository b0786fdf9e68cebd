"""Worms and worm wheels."""
