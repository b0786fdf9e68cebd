"""The part kind ``face_gear`` and its calculation."""
