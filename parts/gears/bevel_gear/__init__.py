"""The part kind ``bevel_gear`` and its calculation."""
