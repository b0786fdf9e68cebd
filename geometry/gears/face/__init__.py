"""Face gears: crown wheels that a spur pinion drives at a right angle."""
