"""A study: one analysis computed in many ways, and what stabilization, scheme, tolerance do."""

from kempe.studies.outcome import Outcome
from kempe.studies.run import Study, study
from kempe.studies.variants import Variant, variants

__all__ = ["Outcome", "Study", "Variant", "study", "variants"]
