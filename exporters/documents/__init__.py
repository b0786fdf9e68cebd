"""Calculations and checks as text, pictures and drawings of contours."""
