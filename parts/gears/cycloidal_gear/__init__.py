"""The part kind ``cycloidal_gear`` and its calculation."""
