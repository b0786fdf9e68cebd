"""Tests of ``exporters/command``."""
