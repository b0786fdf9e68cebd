"""Laws of motion as chains of analytic pieces."""
