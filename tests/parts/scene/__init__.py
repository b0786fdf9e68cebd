"""Tests of ``parts/scene``."""
