"""One verb a file. An operator gathers, asks the session to solve, applies, and reports; it calls no other operator."""
