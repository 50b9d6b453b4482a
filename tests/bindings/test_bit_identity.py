"""Restructuring changes no bit: `positions` of every tool hash to what bit_identity.json holds, with 1 and 2 threads.

A change that is meant to alter results writes the hashes again, and its commit says by how much results moved:

    PYTHONPATH=addon python3 tests/bindings/test_bit_identity.py --write
"""
import json
import os
import platform
import subprocess
import sys
from pathlib import Path

import pytest

HASHES = Path(__file__).with_name("bit_identity.json")
PROGRAM = Path(__file__).with_name("bit_identity.py")


def why_not() -> str | None:
    """Why this machine's bits say nothing about the code; None where they do."""
    wanted = json.loads(HASHES.read_text())["libc"]
    if "REFLINES_FOLDER" in os.environ:
        return "an installed package has other libraries inside than the ones the hashes were made with"
    if not {"avx2", "fma"} <= set(Path("/proc/cpuinfo").read_text().split()):
        return "this processor has no AVX2, so that BLAS takes other kernels than the hashes were made with"
    if " ".join(platform.libc_ver()) != wanted:
        return f"the hashes were made with {wanted}, whose sines may differ from this system's in the last bit"
    return None


def hashes(threads: int) -> dict[str, str]:
    path = os.pathsep.join(filter(None, sys.path))
    environment = os.environ | {"OPENBLAS_CORETYPE": "Haswell", "OMP_NUM_THREADS": str(threads),
                                "OPENBLAS_NUM_THREADS": str(threads), "PYTHONPATH": path}
    run = subprocess.run([sys.executable, PROGRAM], env=environment, check=True, text=True, stdout=subprocess.PIPE)
    return json.loads(run.stdout)


@pytest.mark.parametrize("threads", [1, 2])
def test_results_keep_their_bits(threads: int) -> None:
    if reason := why_not():
        pytest.skip(reason)
    wanted = json.loads(HASHES.read_text())["hashes"]
    found = hashes(threads)
    assert found.keys() == wanted.keys()
    changed = [name for name in wanted if found[name] != wanted[name]]
    assert not changed, f"{len(changed)} of {len(wanted)} results have other bits: {changed}"


if __name__ == "__main__" and sys.argv[1:] == ["--write"]:
    record = {"libc": " ".join(platform.libc_ver()), "hashes": hashes(1)}
    HASHES.write_text(json.dumps(record, indent=1) + "\n")
