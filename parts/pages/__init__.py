"""Calculations as data, step by step."""
