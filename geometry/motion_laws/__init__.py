"""Laws of motion: acceleration diagrams, their closed integrals, and the laws that have names."""
