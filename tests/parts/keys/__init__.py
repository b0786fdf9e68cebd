"""Tests of ``parts/keys``."""
