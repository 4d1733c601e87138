"""Models: their elements, the checks of their values, and the compiled model."""
