"""Exact curves as chords, arcs and splines, each with a bound of its error."""
