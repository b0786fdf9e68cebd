"""Cams whose follower sits on a connecting rod."""
