"""Gears of pins: cycloidal discs and lanterns."""
