"""Ring gears."""
