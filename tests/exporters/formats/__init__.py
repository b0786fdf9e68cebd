"""Tests of ``exporters/formats``."""
