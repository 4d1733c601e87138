"""Assemblies in the format `.asmt` of OndselSolver, the solver of the assemblies of FreeCAD."""
