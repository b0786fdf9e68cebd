"""Motions of the plane: linkages, centrodes and poses."""
