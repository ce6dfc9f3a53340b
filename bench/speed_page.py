"""Brings docs/speed.md and its charts up to date: runs the benchmark and puts what it measured between the page's marks.

    speed_page.py HALFSPACE [--out out/bench] [--again]

--again takes what is in the folder already. What stands outside of the marks is written by hand.
"""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
RUNS = {"workloads": [], "limits": ["limits"], "scale": ["scale"], "cores": ["cores"]}


def run(halfspace, out):
    for words in RUNS.values():
        done = subprocess.run([halfspace, "bench", *words, "--out", out], check=False)
        if done.returncode not in (0, 1):  # 1: a target was missed, which is what the page tells
            sys.exit(f"speed_page: bench {' '.join(words)} could not measure")


def table(heading, rows):
    right = [heading[0], *heading[1:]]
    lines = ["| " + " | ".join(right) + " |", "|---" + "|--:" * (len(heading) - 1) + "|"]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def milliseconds(value):
    return f"{value:.3g}" if value < 100 else f"{value:.0f}"


def threads_cell(threads):
    far = threads.get("core_distance_ns", 0) > 120  # no cache in common; with one some 60
    return f"{threads['speed_up']:.2f}" + (" far" if far else "")


def workloads_table(result):
    rows = []
    for row in result["workloads"]:
        ours, theirs = row["ours"]["cpu_ms"], row["theirs"]["cpu_ms"]
        threads = row.get("threads")
        rows.append([f"`{row['name']}`" + (" at draft" if row["draft"] else ""),
                     f"{milliseconds(ours['median'])} ± {100 * ours['spread']:.0f} %",
                     f"{milliseconds(theirs['median'])} ± {100 * theirs['spread']:.0f} %",
                     f"**{row['ratio']:.1f}**" if row["ratio"] >= row["target"] else f"{row['ratio']:.1f}",
                     f"{row['target']:g}",
                     threads_cell(threads) if threads else "",
                     f"{100 * row['limit_ms'] / ours['median']:.0f} %" if "limit_ms" in row else ""])
    met = sum(row["ratio"] >= row["target"] for row in result["workloads"])
    return [f"{result['ours']['renderer']} and {result['theirs']['renderer']} on {result['processor']}; {met} of "
            f"{len(rows)} targets met (bold).", "",
            *table(["", "ours, ms", "llvmpipe, ms", "times as fast", "target", "2 threads", "of the limit"], rows)]


def limits_table(result):
    rows = []
    for name, rate in result["per_second"].items():
        kib = re.fullmatch(r"(\w+)/(\d+)", name)
        label = (kib[1] if kib else name).replace("_", " ")
        size = f", {int(kib[2])} KiB" if kib and int(kib[2]) < 1024 else f", {int(kib[2]) // 1024} MiB" if kib else ""
        rows.append([label + size, f"{rate * 1e-9:.2f} {'GB/s' if kib else 'G/s'}"])
    return table(["", "at best"], rows)


def cores_table(result):
    rows = [[f"`{row['name']}`", f"{100 * row['serial_share'][-1]:.0f} %"] +
            [f"{row['one_ms'] / ms:.1f}" for ms in row["frame_ms"]] for row in result["workloads"]]
    return table(["", "serial"] + [f"{cores}" for cores in result["cores"]], rows)


def replace_marked(page, name, lines):
    pattern = re.compile(rf"(<!-- {name} -->\n).*?(<!-- /{name} -->)", re.DOTALL)
    assert pattern.search(page), f"the page has no mark {name}"
    return pattern.sub(lambda found: found[1] + "\n".join(lines) + "\n" + found[2], page)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("halfspace")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out" / "bench")
    parser.add_argument("--again", action="store_true")
    options = parser.parse_args()
    if not options.again:
        run(options.halfspace, options.out)
    results = {name: json.loads((options.out / f"{name}.json").read_text()) for name in RUNS}
    path = ROOT / "docs" / "speed.md"
    page = path.read_text()
    page = replace_marked(page, "workloads", workloads_table(results["workloads"]))
    page = replace_marked(page, "limits", limits_table(results["limits"]))
    page = replace_marked(page, "cores", cores_table(results["cores"]))
    path.write_text(page)
    charts = ROOT / "docs" / "speed"
    charts.mkdir(exist_ok=True)
    for name in ["workloads.svg", "cores.svg", *(f"scale_{curve['name']}.svg" for curve in results["scale"]["curves"])]:
        shutil.copyfile(options.out / name, charts / name)
    print(f"{path} and {charts}")


if __name__ == "__main__":
    main()
