"""Sheets: drawings that explain, in mm on paper, with words."""
