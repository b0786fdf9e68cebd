"""Roller chains and their sprockets: the table of chains, tooth forms, drives of two sprockets."""
