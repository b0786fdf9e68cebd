"""Blocking contours and the choice of profile shifts."""
