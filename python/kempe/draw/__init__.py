"""Drawings of a motion: a description of the scene, and programs that display it."""

from kempe.draw.animate import animate
from kempe.draw.player import player
from kempe.draw.scene import scene
from kempe.draw.still import still

__all__ = ["animate", "player", "scene", "still"]
