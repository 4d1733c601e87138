"""Linkages for a task: poses of the coupler, points of a path, pairs of angles.

    motion                  linkages whose coupler takes poses
    path                    four-bars and six-bars whose coupler point passes points
    cognates                the two other four-bars with the same coupler curve
    function                four-bars and six-bars that couple angles of crank and output
    from_file               the task of a CSV file
    dyads                   all dyads of five poses
    limits                  the limits of candidates that all of them accept
    burmester               the circle-point and centre-point curves of four poses

The results are a sequence of candidates, best first, each with a case for all analyses.
"""

from kempe.base.arguments import explain_functions
from kempe.synthesis.assemble import limits
from kempe.synthesis.burmester import Burmester, burmester
from kempe.synthesis.candidate import Candidate
from kempe.synthesis.cognates import cognates
from kempe.synthesis.dyads import dyads
from kempe.synthesis.found import Followed, Found
from kempe.synthesis.function import function
from kempe.synthesis.motion import motion
from kempe.synthesis.path import path
from kempe.synthesis.read import from_case, from_file
from kempe.synthesis.six_bar.candidate import SixBar
from kempe.synthesis.slider import SliderCrank

__all__ = [
    "Burmester",
    "Candidate",
    "Followed",
    "Found",
    "SixBar",
    "SliderCrank",
    "burmester",
    "cognates",
    "dyads",
    "from_case",
    "from_file",
    "function",
    "limits",
    "motion",
    "path",
]

explain_functions(globals())
