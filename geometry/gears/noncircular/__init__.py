"""Gears whose centrodes are not circles."""
