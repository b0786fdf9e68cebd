"""Plane profiles and regions: distances, measures, envelopes and loops."""
