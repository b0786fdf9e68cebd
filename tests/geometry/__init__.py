"""Tests of geometry: curves, roots, approximation, measuring."""
