"""Sheets of pairs."""
