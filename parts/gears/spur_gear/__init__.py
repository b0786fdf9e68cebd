"""External gears."""
