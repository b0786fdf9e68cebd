"""Cycloidal discs, lanterns, pins and their plates."""
