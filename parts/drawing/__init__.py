"""Paper: canvas, labels, tables, title blocks, and what a sheet is held against."""
