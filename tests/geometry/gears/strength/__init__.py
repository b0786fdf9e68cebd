"""Tests of the load capacity of gears."""
