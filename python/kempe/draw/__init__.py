"""Drawings of a motion: one description of the scene, and what shows it."""

from kempe.draw.scene import scene

__all__ = ["scene"]
