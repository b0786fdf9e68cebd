"""Files read back, held against the exact geometry."""
