"""The sheets of cams: diagrams, least radius, profile."""
