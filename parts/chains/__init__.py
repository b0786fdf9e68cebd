"""Kinds and calculations of chain drives: sprockets."""
