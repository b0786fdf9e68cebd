"""Tests of exporters.boards."""
