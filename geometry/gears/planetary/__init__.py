"""Planetary sets of involute wheels: their teeth in exact arithmetic, and the shifts that bring them together."""
