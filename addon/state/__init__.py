"""What outlives an operator: the optimizer cache, the solve history, and what of it is saved with the file."""
