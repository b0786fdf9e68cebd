"""Parametric parts and the scenes that hold them."""
