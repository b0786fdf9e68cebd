"""What everything stands on: errors, tolerances, roots, series, angles and placements."""
