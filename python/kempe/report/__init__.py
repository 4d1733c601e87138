"""Reports of a solution as text and numbers; uses the public interface of Solution only."""

from kempe.results.summary import summary

__all__ = ["summary"]
