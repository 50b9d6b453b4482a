"""Writes how far the cases of tests/bindings/bit_identity.py move their vertices, to compare two systems' solves.

    moves.py FILE

The meshes are made without functions whose last bits a system's library decides, so that all start from the same bits.
"""
import sys
from collections.abc import Iterator

import numpy as np
import reflines
from bit_identity import SOLVERS, cage_cases, mesh_cases


def moves() -> Iterator[tuple[str, np.ndarray]]:
    for solver in SOLVERS:
        for name, build, build_target, options in (*mesh_cases(), *cage_cases()):
            optimizer = build(linear_solver=solver)
            before = optimizer.positions
            optimizer.solve(build_target(optimizer), **options)
            optimizer.solve(reflines.smooth(optimizer, length=0.3), **options)
            yield f"{name} / {solver}", optimizer.positions - before


if __name__ == "__main__":
    np.savez(sys.argv[1], **dict(moves()))
