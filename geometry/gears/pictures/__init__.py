"""What lessons draw of gears: generating, meshing and readings."""
