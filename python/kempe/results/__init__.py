"""Results: motions, solutions and states, their quantities, measures and files."""
