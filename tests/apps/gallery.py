"""Real programs on our libGL, beside Mesa's: makes docs/programs.md and its pictures again.

    gallery.py --libraries DIRECTORY --halfspace COMMAND --own DIRECTORY [--out DIRECTORY] [--only NAME ...]

Each program of gallery/programs.json runs on our libGL under Xvfb while apitrace records its calls. Both libraries then
draw the same recorded frame (glretrace), and `halfspace compare` counts what differs. So an animation is compared with
itself, and what is shown is what the unchanged program asked our library to draw.
"""
import argparse
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
WIDTH = 320  # of a thumbnail, pixels


def clean_environment(**extra):
    clean = {k: v for k, v in os.environ.items() if not k.startswith(("LD_", "HALFSPACE_", "LIBGL", "MESA", "GALLIUM"))}
    return clean | {"SDL_AUDIODRIVER": "dummy", "ALSOFT_DRIVERS": "null"} | {k: str(v) for k, v in extra.items()}


class Gallery:
    def __init__(self, options, scratch):
        self.options, self.scratch = options, scratch
        self.ours = clean_environment(LD_LIBRARY_PATH=options.libraries.resolve())
        self.mesa = clean_environment(LIBGL_ALWAYS_SOFTWARE="1")

    def check_renderers(self):
        """Neither library may stand in for the other."""
        for environment, wanted in ((self.ours, "Halfspace"), (self.mesa, "llvmpipe")):
            text = subprocess.run(["glxinfo"], env=environment, capture_output=True, text=True, timeout=60).stdout
            renderer = re.search(r"OpenGL renderer string: (.*)", text)
            if not renderer or wanted not in renderer[1]:
                sys.exit(f"gallery: expected {wanted} to draw, found {renderer[1] if renderer else 'nothing'}")

    def record(self, program, trace):
        """Runs the program on our library for its seconds, then asks it to stop."""
        command = [word.replace("{own}", str(self.options.own.resolve())).replace("{here}", str(HERE / "gallery"))
                   for word in shlex.split(program["command"])]
        home = self.scratch / "home"
        home.mkdir(exist_ok=True)
        process = subprocess.Popen(["apitrace", "trace", "--api=gl", "-o", str(trace), *command],
                                   env=self.ours | {"HOME": str(home)}, cwd=self.scratch, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, start_new_session=True, text=True, errors="replace")
        try:
            _, errors = process.communicate(timeout=program.get("seconds", 4))
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGINT)
            try:
                _, errors = process.communicate(timeout=10)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                _, errors = process.communicate()
        return "\n".join(line for line in errors.splitlines() if line.startswith("halfspace:"))

    def frame_call(self, program, trace):
        """The number of the call that ends the frame to show, and of the last one recorded."""
        dump = subprocess.Popen(["apitrace", "dump", "--color=never", "--arg-names=no", str(trace)], text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, errors="replace")
        ends, calls, wanted = [], {}, program.get("frame", 30)
        for line in dump.stdout:
            found = re.match(r"(\d+)(?::\d+)? (gl\w+)\(", line)
            if not found:
                continue
            calls[found[2]] = calls.get(found[2], 0) + 1
            if "SwapBuffers" in found[2] or (program.get("single") and found[2] in ("glFinish", "glFlush")):
                ends.append(int(found[1]))
            if len(ends) >= wanted:
                break
        dump.kill()
        return (ends[-1] if ends else None), len(ends), calls

    def replay(self, trace, call, environment, prefix):
        subprocess.run(["glretrace", "-s", prefix, f"--snapshot={call}", f"--snapshot-format=PNG", str(trace)], env=environment,
                       cwd=self.scratch, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=600)
        made = sorted(self.scratch.glob(Path(prefix).name + "*.png"))
        return made[-1] if made else None

    def show(self, program):
        """One row: numbers of the comparison and the thumbnail, or what went wrong."""
        name = program["name"]
        slug = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")
        trace = self.scratch / f"{slug}.trace"
        row = {"name": name, "package": program["package"], "command": program["command"], "slug": slug,
               "shows": program["shows"], "why": program.get("why")}
        row["messages"] = self.record(program, trace)
        if not trace.exists():
            return row | {"failed": "it did not start"}
        call, frames, calls = self.frame_call(program, trace)
        row["frames"], row["functions"] = frames, len(calls)
        if call is None:
            return row | {"failed": "no frame was drawn"}
        ours = self.replay(trace, call, self.ours, str(self.scratch / f"{slug}_ours_"))
        mesa = self.replay(trace, call, self.mesa, str(self.scratch / f"{slug}_mesa_"))
        if not ours or not mesa:
            return row | {"failed": "the recording could not be drawn by " + ("Mesa" if ours else "ours")}
        numbers = self.scratch / f"{slug}.json"
        subprocess.run([str(self.options.halfspace), "compare", str(ours), str(mesa), "--json", str(numbers)],
                       stdout=subprocess.DEVNULL, timeout=300)
        picture = json.loads(numbers.read_text())["pictures"][0]
        if "difference" not in picture:
            return row | {"failed": "the pictures are of different size"}
        counts = picture["difference"]
        row["compare"] = {"differing_percent": counts["differing_percent"], "largest": round(counts["max"]),
                          "over_8_percent": 100 * counts["above_8"] / counts["pixels"]}
        self.thumbnail(ours, self.options.out / "programs" / f"{slug}.png")
        if self.options.keep:
            for picture, who in ((ours, "ours"), (mesa, "mesa")):
                shutil.copy(picture, self.options.keep / f"{slug}_{who}.png")
        return row

    @staticmethod
    def thumbnail(picture, out):
        out.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(["convert", str(picture), "-alpha", "off", "-resize", f"{WIDTH}x", "-colors", "96", "-strip",
                        f"PNG8:{out}"], check=True)


def page(rows):
    lines = [
        "# Programs on Halfspace", "",
        "Unchanged programs on our `libGL.so.1`, by library path. Each was recorded while it ran on ours (apitrace); ours and",
        "Mesa's llvmpipe then drew the same recorded frame, and `halfspace compare` counted the pixels that differ, and by how",
        "many of 255 levels. The table and the pictures are made again by `./halfspace gallery`.", "",
        "| program | package | frame | pixels that differ | by more than 8 levels | largest difference |",
        "|---|---|--:|--:|--:|--:|"]
    for row in rows:
        if "failed" in row:
            lines.append(f"| {row['name']} | {row['package']} | | {row['failed']} | | |")
            continue
        c = row["compare"]
        lines.append(f"| [{row['name']}](#{row['slug']}) | {row['package']} | {row['frames']} | {c['differing_percent']:.2f} % | "
                     f"{c['over_8_percent']:.2f} % | {c['largest']} |")
    for row in rows:
        if "failed" in row:
            continue
        lines += ["", f"<a id=\"{row['slug']}\"></a>", "", f"![{row['name']}](programs/{row['slug']}.png)", "",
                  f"**{row['name']}**: {row['shows']}. Package {row['package']}, `{row['command']}`, {row['functions']} "
                  "different functions called."]
        if row["why"]:
            lines.append(row["why"] + ".")
        if row["messages"]:
            lines.append("It said: `" + row["messages"].replace("\n", "`, `") + "`.")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--libraries", type=Path, required=True, help="where our libGL.so.1 is")
    parser.add_argument("--halfspace", type=Path, required=True, help="the halfspace command")
    parser.add_argument("--own", type=Path, required=True, help="where the programs of gallery/ are built")
    parser.add_argument("--out", type=Path, default=HERE.parent.parent / "docs")
    parser.add_argument("--keep", type=Path, help="also leave full-size pictures of both here")
    parser.add_argument("--only", nargs="*", help="these programs, and print instead of writing the page")
    options = parser.parse_args()
    programs = json.loads((HERE / "gallery" / "programs.json").read_text())
    if options.only:
        programs = [p for p in programs if p["name"] in options.only]
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        gallery = Gallery(options, Path(scratch))
        gallery.check_renderers()
        rows = []
        for i, program in enumerate(programs):
            started = time.monotonic()
            rows.append(gallery.show(program))
            c = rows[-1].get("compare")
            says = rows[-1].get("failed") or f"{c['differing_percent']:.2f} % differ, {c['over_8_percent']:.2f} % by more than 8"
            print(f"[{i + 1}/{len(programs)}] {program['name']}: {says} ({time.monotonic() - started:.0f} s)", flush=True)
            if rows[-1]["messages"]:
                print("    " + rows[-1]["messages"].replace("\n", "\n    "))
            for leftover in Path(scratch).glob("*.trace"):
                leftover.unlink()
    if not options.only:
        (options.out / "programs.md").write_text(page(rows))
    return 1 if any("failed" in row for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
