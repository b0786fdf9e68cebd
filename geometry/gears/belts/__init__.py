"""Timing belts: their grooves by standards, pulleys, and two pulleys with a belt."""
