"""Ratchet wheels and their pawls."""
