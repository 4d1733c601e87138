"""Cams: programmes of the follower, profiles, limits, cases and files."""

from kempe.base.arguments import explain_functions
from kempe.design.cams.cam import Cam
from kempe.design.cams.curves import Drive
from kempe.design.cams.laws import Piece, Programme
from kempe.design.cams.make import cam
from kempe.design.cams.read import read_programme
from kempe.design.cams.shape import Follower, Shape

__all__ = ["Cam", "Drive", "Follower", "Piece", "Programme", "Shape", "cam", "read_programme"]

explain_functions(globals())
