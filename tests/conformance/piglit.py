"""What the runner knows of piglit: how its names map to commands, and how to read what a test prints."""
import ast
import dataclasses
import gzip
import json
import os
import subprocess
import time
import xml.etree.ElementTree
from pathlib import Path

# Worse results come later; those of subtests are summed up by the worst.
ORDER = ["pass", "skip", "warn", "fail", "timeout", "crash", "none"]


@dataclasses.dataclass
class Result:
    name: str
    status: str
    seconds: float = 0.0
    output: str = ""
    subtests: dict = dataclasses.field(default_factory=dict)


def find_installation():
    """The folder that holds piglit's bin/ and tests/, or None. PIGLIT_DIR names one that is not Debian's."""
    candidates = [Path(os.environ["PIGLIT_DIR"])] if "PIGLIT_DIR" in os.environ else \
        sorted(Path("/usr/lib").glob("*/piglit")) + [Path("/usr/lib/piglit")]
    return next((folder for folder in candidates if (folder / "bin").is_dir()), None)


def commands(installation):
    """name -> [program, arguments...], from the profile piglit itself runs."""
    with gzip.open(installation / "tests" / "opengl.xml.gz") as file:
        profile = xml.etree.ElementTree.parse(file).getroot()
    found = {}
    for test in profile.iter("Test"):
        options = {option.get("name"): option.get("value") for option in test.iter("option")}
        if test.get("type") == "gl" and "command" in options:
            # An empty argument is what the profile makes of a choice left out.
            found[test.get("name")] = [word for word in ast.literal_eval(options["command"]) if word]
    return found


def read_reports(output):
    """A test reports by lines `PIGLIT: {json}`: its result, or that of a subtest."""
    status, subtests = None, {}
    for line in output.splitlines():
        # Text without an end of line may stand before it.
        _, found, report = line.partition("PIGLIT: ")
        if not found:
            continue
        try:
            report = json.loads(report)
        except json.JSONDecodeError:
            continue
        status = report.get("result", status)
        subtests.update(report.get("subtest", {}))
    return status, subtests


def judge(return_code, output):
    """(status, subtests) of a test that has ended."""
    status, subtests = read_reports(output)
    if return_code < 0:
        return "crash", subtests
    if status is None:
        # It ended without a word: through exit() in a library, say.
        return "none", subtests
    worst = max([status, *subtests.values()], key=lambda s: ORDER.index(s) if s in ORDER else len(ORDER))
    if return_code > 0 and worst == "pass":
        worst = "warn"
    return worst, subtests


def run(installation, name, command, env, timeout):
    """Runs one test in a window (without -fbo: GL 1.1 has no framebuffer objects)."""
    program, *arguments = command
    start = time.monotonic()
    with subprocess.Popen([installation / "bin" / program, *arguments, "-auto"], env=env, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
        try:
            output, _ = process.communicate(timeout=timeout)
            ended = True
        except subprocess.TimeoutExpired:
            process.kill()
            output, _ = process.communicate()
            ended = False
    text = output.decode(errors="replace")
    status, subtests = judge(process.returncode, text) if ended else ("timeout", {})
    return Result(name, status, time.monotonic() - start, text, subtests)
