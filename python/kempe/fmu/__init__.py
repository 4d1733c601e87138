"""Functional mock-up units (FMUs): a case as a component of other simulation tools."""
