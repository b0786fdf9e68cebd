"""Tests of the laws of motion."""
