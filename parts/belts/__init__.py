"""The part kind of timing belts: pulleys."""
