"""Tests of ``parts/mates``."""
