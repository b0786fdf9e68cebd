"""Tests of ``exporters/documents``."""
