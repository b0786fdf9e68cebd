"""Sheets as files: written, read, held against what they should show."""
