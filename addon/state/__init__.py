"""State beyond one operator: the optimizer cache, the solve history, and the part of it that is saved with the file."""
