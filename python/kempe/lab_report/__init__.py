"""Reports of an analysis as one HTML or PDF file; uses the public interface of Case and Solution.

``subject`` collects the model, its start and its results, one file for each section describes them
as blocks, and ``write`` typesets the blocks.
"""

from kempe.lab_report.write import write_report

__all__ = ["write_report"]
