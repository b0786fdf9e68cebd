"""Textbook calculations, step by step: formulas, numbers and the sources' equation numbers; one file a topic."""
