"""Scenes: loading, instances, placing, checks."""
