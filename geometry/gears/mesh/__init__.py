"""The exact search for gaps and contact of meshing teeth."""
