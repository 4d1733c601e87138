"""A study: one analysis with many stabilizations, schemes and tolerances, and a comparison."""

from kempe.studies.outcome import Outcome
from kempe.studies.run import Study, study
from kempe.studies.variants import Variant, variants

__all__ = ["Outcome", "Study", "Variant", "study", "variants"]
