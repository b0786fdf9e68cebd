"""Tests of ``geometry/curves``."""
