"""Cylindrical worms, the wheels that they envelop, and the strength of both."""
