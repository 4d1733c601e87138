"""The draft of a paper, and the numbers in it."""
