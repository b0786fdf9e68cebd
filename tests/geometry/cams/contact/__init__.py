"""Tests of geometry/cams/contact."""
