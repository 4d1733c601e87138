"""What a solution says, in words and numbers; sees a Solution and nothing under it."""

from kempe.report.summary import summary

__all__ = ["summary"]
