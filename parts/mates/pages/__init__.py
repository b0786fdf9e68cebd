"""Calculations of pairs."""
