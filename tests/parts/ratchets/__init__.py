"""Tests of ``parts/ratchets``."""
