"""Instructions a program executes on our library, counted by valgrind's callgrind.

A count does not depend on how busy the machine is. It is taken at AVX2, the widest level valgrind knows, on one thread.
"""
import os
import re
import subprocess
import sys
import tempfile

ENVIRONMENT = {"HALFSPACE_THREADS": "1", "HALFSPACE_ISA": "avx2"}


def instructions(command, environment=None, expected=""):
    """How many `command` executes; ends this program when it fails or does not print `expected`."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out", *map(str, command)],
                              env=os.environ | ENVIRONMENT | (environment or {}), capture_output=True, text=True, check=False)
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode or not found or expected not in done.stdout:
        sys.exit(f"callgrind: did not run: {' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return int(found[1])
