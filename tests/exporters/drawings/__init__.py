"""Tests of ``exporters/drawings``."""
