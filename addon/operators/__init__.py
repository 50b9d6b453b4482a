"""The operators, one a file: they gather, solve, apply and report, and call no other operator."""
