"""The matrices and the equations of motion: as arrays, and printed with names."""
