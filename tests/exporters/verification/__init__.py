"""Tests of ``exporters/verification``."""
