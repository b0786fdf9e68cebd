"""Face gears."""
