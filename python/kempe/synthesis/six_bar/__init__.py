"""Six-bars of Watt and Stephenson for functions and paths.

topology    the families as data, closures, positions
starts      an atlas of random six-bars, and those that resemble a task
fit         least squares of many starts side by side
candidate   a six-bar as a case
judge       its defects, by analyses of the case
search      from a task to candidates
"""
