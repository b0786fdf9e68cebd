"""What is known of materials: densities by name and by mark, in the letters of their standards."""

from __future__ import annotations

from parts.base.psv import rows_of

# g/cm^3; a part's own key `density` goes before them
NAMES = {name: float(density) for name, density in rows_of(__file__, "density_names")}
# marks, and the same names in other letters
ROWS = [(float(density), row) for density, row in rows_of(__file__, "densities")]
DENSITIES = NAMES | {mark: density for density, row in ROWS for mark in row.split(", ")}
