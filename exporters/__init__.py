"""Files for manufacture, each read back and measured, and the command that makes them."""

__version__ = "0.1.0"
