"""Bevel gears of exact spherical involutes: straight, skew, zerol, spiral."""
