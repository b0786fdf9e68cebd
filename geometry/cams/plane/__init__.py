"""Plane cams: disks, grooves, pairs of cams, couplers and wedges."""
