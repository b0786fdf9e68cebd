"""Tests of ``parts/pages``."""
