"""Texts for users by code: findings, quantities, checks, sheets."""
