"""Tests of ``parts/base``."""
