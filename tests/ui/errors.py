"""What Blender writes of errors of Python in drawing, which it goes on after."""
import os
import sys
import tempfile
from collections.abc import Generator

Steps = Generator[float, None, None]


def read_errors(steps: Steps) -> Generator[float, None, str]:
    """Takes the steps; returns what was written to the standard error meanwhile."""
    with tempfile.TemporaryFile(mode="w+", errors="replace") as errors:
        kept = os.dup(2)
        os.dup2(errors.fileno(), 2)
        try:
            yield from steps
        finally:
            sys.stderr.flush()
            os.dup2(kept, 2)
        errors.seek(0)
        return errors.read()
