"""Tests of sprockets in scenes."""
