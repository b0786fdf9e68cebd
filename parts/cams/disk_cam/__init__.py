"""Disk cams."""
