"""Tests of ``exporters/production``."""
