"""Straight bevel gears of exact spherical involutes."""
