"""Scene keys that kinds share."""
