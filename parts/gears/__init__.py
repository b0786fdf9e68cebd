"""The kinds of gears."""
