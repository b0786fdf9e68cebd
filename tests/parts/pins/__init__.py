"""Tests of ``parts/bodies``."""
