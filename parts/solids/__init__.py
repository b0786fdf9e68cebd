"""Meshes and solids of the kernel from exact bodies."""
