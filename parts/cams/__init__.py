"""The kinds of cams and of what they move."""
