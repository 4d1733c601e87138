"""Only the version, so that a query for it loads no other module."""

__version__ = "0.1.0"
