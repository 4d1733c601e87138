"""The studio: a page that draws, moves and simulates mechanisms in a browser."""
