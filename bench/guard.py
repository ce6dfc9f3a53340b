"""Guards against becoming slower unawares: instructions a frame of five short workloads takes, beside those on record.

    guard.py WORKLOADS LIBRARY [--record FILE] [--limit PERCENT] [--write]

The record is instruction_counts.json beside this file. More than the limit (5 %) over it is a failure; so much under it
is said, and worth recording. --write records what is counted now.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import shutil
import sys

import callgrind

# Together they touch fills, textures, blending, fog, set-up of small triangles, lighting, state changes, glBegin.
WORKLOADS = {"fill_depth": 256, "tex_full": 256, "tri_10px": 256, "mesh_lit": 512, "many_state_changes": 512}
SKIPPED = 77  # what ctest takes for a test that cannot run here


def count(program, library, workload, frames):
    size = WORKLOADS[workload]
    return callgrind.instructions([program, "--library", library, "--only", workload, "--frames", frames,
                                   "--width", size, "--height", size], expected=workload)


def frame(program, library, workload):
    """The first frames fill caches: what counts is what one more takes."""
    return count(program, library, workload, 2) - count(program, library, workload, 1)


def count_all(program, library):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        waiting = {name: pool.submit(frame, program, library, name) for name in WORKLOADS}
        return {name: result.result() for name, result in waiting.items()}


def judge(counts, record, limit):
    """Prints a line a workload; the names of those that became slower, and of those that became faster."""
    slower, faster = [], []
    print(f"{'instructions a frame':24} {'on record':>14} {'now':>14}  change")
    for name, now in counts.items():
        before = record.get(name)
        if not before:
            slower.append(name)
            print(f"{name:24} {'-':>14} {now:14,}  not on record")
            continue
        change = 100 * (now - before) / before
        (slower if change > limit else faster if change < -limit else []).append(name)
        print(f"{name:24} {before:14,} {now:14,}  {change:+.2f} %{'  SLOWER' if change > limit else ''}")
    return slower, faster


def advice(options):
    return (f"    python3 bench/guard.py {options.program} {options.library} --write\n"
            "records the new counts; commit bench/instruction_counts.json with the change that is the reason.")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("library")
    parser.add_argument("--record", type=pathlib.Path, default=pathlib.Path(__file__).parent / "instruction_counts.json")
    parser.add_argument("--limit", type=float, default=5, help="per cent")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    if not shutil.which("valgrind") or "avx2" not in pathlib.Path("/proc/cpuinfo").read_text():
        print("guard: needs valgrind and a processor with AVX2")
        return SKIPPED
    counts = count_all(options.program, options.library)
    if options.write:
        options.record.write_text(json.dumps(counts, indent=2) + "\n")
        print(f"recorded in {options.record}:\n{json.dumps(counts, indent=2)}")
        return 0
    slower, faster = judge(counts, json.loads(options.record.read_text()), options.limit)
    if slower:
        print(f"\n{', '.join(slower)}: more than {options.limit:g} % over the record. `./halfspace bench --against` the build "
              f"before\nshows what it means in time, `perf record` where. If it has to be:\n{advice(options)}")
    elif faster:
        print(f"\n{', '.join(faster)}: more than {options.limit:g} % under the record, which would hide as much of a loss "
              f"later:\n{advice(options)}")
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
