"""Tests of gears cut by generation."""
