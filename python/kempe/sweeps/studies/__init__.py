"""A study: one analysis with many stabilizations, schemes and tolerances, and a comparison."""

from kempe.sweeps.studies.outcome import Outcome
from kempe.sweeps.studies.run import Study, study
from kempe.sweeps.studies.variants import Variant, variants

__all__ = ["Outcome", "Study", "Variant", "study", "variants"]
