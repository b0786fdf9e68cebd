"""Kinds of ratchets: wheels, which turn in one sense alone, and their pawls."""
