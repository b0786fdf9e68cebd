"""Cycloidal gears of clocks, exact."""
