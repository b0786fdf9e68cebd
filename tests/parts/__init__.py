"""Tests of ``parts``: scenes, refusals and solids."""
