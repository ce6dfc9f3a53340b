"""The ./halfspace script in a tree of its own, with apt-get, cmake, ninja and ctest replaced by programs that only
write down how they were called.

usage: script_test.py SCRIPT
"""

import os
import pathlib
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path()

STUBS = {
    "id": 'echo "${FAKE_UID:-0}"',
    "dpkg-query": r'cat "$CALLS/installed"',
    "apt-get": 'echo "apt-get $*" >> "$CALLS/log"; if [ -n "${FAKE_APT_FAILS:-}" ]; then exit 100; fi',
    "sudo": 'echo sudo >> "$CALLS/log"; exec "$@"',
    "cmake": 'echo "cmake $*" >> "$CALLS/log"; preset=$2; mkdir -p "build/$preset"; '
             'touch "build/$preset/build.ninja"; for a in "$@"; do case $a in -D*) a=${a#-D}; '
             'echo "${a%%=*}:BOOL=${a#*=}" >> "build/$preset/CMakeCache.txt" ;; esac; done',
    "ninja": r"""
case " $* " in
  *" -t targets "*) printf 'some_test: phony\nlib/x.so: phony\nother_test: phony\n' ;;
  *" -n "*) if [ -n "${FAKE_BUILT:-}" ]; then echo 'ninja: no work to do.'; fi ;;
  *) echo "ninja $*" >> "$CALLS/log"; case $* in *"${FAKE_NINJA_FAILS:-none}"*) exit 1 ;; esac ;;
esac""",
    "xvfb-run": 'echo "xvfb-run" >> "$CALLS/log"; while [ "$1" != ctest ]; do shift; done; exec "$@"',
    "ctest": r"""
case " $* " in *" --show-only"*) printf "$FAKE_TESTS" "$2"; exit 0 ;; esac
echo "ctest $*" >> "$CALLS/log"
while [ $# -gt 0 ]; do
  case $1 in --output-log) out=$2 ;; --test-dir) dir=$2 ;; esac
  shift
done
[ "${FAKE_FAILING:-}" = crash ] && exit 139
case $dir in
  *"${FAKE_FAILING:-none}") echo '80% tests passed, 2 tests failed out of 10' > "$out"; exit 8 ;;
  *) echo '100% tests passed, 0 tests failed out of 10' > "$out" ;;
esac""",
}
# Two tests: a program that is not built yet, and a script that is handed a library; %s is the build tree.
FAKE_TESTS = ('{"tests": [{"name": "unit.some_test"}, '
              '{"name": "api.names", "command": ["/usr/bin/python3", "/elsewhere/names.py", "%s/lib/x.so"]}]}')
INSTALLED = "installed alpha, \ninstalled other, beta (= 1.2), delta\ndeinstall gamma, \n"


class Script(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name) / "a tree"
        (self.root / "cmake").mkdir(parents=True)
        self.script = shutil.copy(SCRIPT, self.root)
        self.packages("build alpha\nbuild beta\ntest delta\n")
        (self.root / "tests" / "conformance").mkdir(parents=True)
        (self.root / "tests" / "conformance" / "run.py").write_text(
            'import os; open(os.environ["CALLS"] + "/log", "a").write("conformance\\n")\n'
            'print("100% tests passed, 0 tests failed out of 10")\n')
        self.calls = pathlib.Path(folder.name) / "calls"
        self.calls.mkdir()
        (self.calls / "installed").write_text(INSTALLED)
        self.stubs = pathlib.Path(folder.name) / "bin"
        self.stubs.mkdir()
        for name, body in STUBS.items():
            stub = self.stubs / name
            stub.write_text("#!/usr/bin/env bash\n" + body + "\n")
            stub.chmod(stub.stat().st_mode | stat.S_IXUSR)

    def packages(self, text):
        (self.root / "cmake" / "debian-packages.txt").write_text("# a comment\n" + text)

    def program(self, text):
        path = self.root / "build" / "release" / "compare" / "halfspace"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("#!/usr/bin/env bash\n" + text + "\n")
        path.chmod(0o755)

    def run_script(self, *arguments, **environment):
        env = {**os.environ, "PATH": f"{self.stubs}:/usr/bin:/bin", "CALLS": str(self.calls),
               "FAKE_TESTS": FAKE_TESTS, **environment}
        for name in ("DISPLAY", "HALFSPACE_WERROR"):
            if name not in environment:
                env.pop(name, None)
        done = subprocess.run([self.script, *arguments], cwd="/", env=env, capture_output=True, text=True, timeout=60)
        log = self.calls / "log"
        calls = log.read_text().splitlines() if log.exists() else []
        log.unlink(missing_ok=True)
        return done, calls

    def test_usage(self):
        for arguments in ((), ("help",), ("--help",)):
            done, calls = self.run_script(*arguments)
            self.assertEqual((done.returncode, calls), (0, []))
            self.assertIn("demo", done.stdout)

    def test_setup_installs_only_what_is_missing(self):
        done, calls = self.run_script("setup")
        self.assertEqual((done.returncode, calls), (0, []))
        self.packages("build alpha\nbuild gamma\ntest epsilon\n")
        done, calls = self.run_script("setup")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("installing 2 packages: epsilon gamma", done.stderr)
        self.assertTrue(calls[-1].endswith("epsilon gamma"), calls)
        self.assertNotIn("sudo", calls)

    def test_setup_without_being_root(self):
        self.packages("build gamma\n")
        done, calls = self.run_script("setup", FAKE_UID="1000")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("sudo", calls)
        done, _ = self.run_script("setup", FAKE_APT_FAILS="1")
        self.assertEqual(done.returncode, 2)

    def test_demo_needs_no_test_packages_and_writes_into_the_tree(self):
        self.packages("build alpha\ntest gamma\n")
        self.program('printf "%s\\n" "$@"')
        done, calls = self.run_script("demo", "--frames", "1")
        self.assertEqual(done.stdout.splitlines(), ["demo", "--frames", "1", "--out", str(self.root / "out/demo")])
        self.assertFalse([call for call in calls if call.startswith("apt-get")])
        self.assertIn("HALFSPACE_BUILD_TESTS=OFF", calls[0])
        done, calls = self.run_script("demo", "--out", "mine", FAKE_BUILT="1")
        self.assertEqual((done.stdout.splitlines(), calls), (["demo", "--out", "mine"], []))

    def test_other_words_are_handed_on(self):
        self.program('printf "%s\\n" "$@"; exit 5')
        done, _ = self.run_script("compare", "a b", "c")
        self.assertEqual((done.returncode, done.stdout), (5, "compare\na b\nc\n"))

    def test_a_broken_build_stops(self):
        self.program("echo started")
        done, _ = self.run_script("compare", FAKE_NINJA_FAILS="release")
        self.assertEqual((done.returncode, done.stdout), (2, ""))

    def test_all_tests_run_on_all_builds(self):
        done, calls = self.run_script("test", HALFSPACE_WERROR="1")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(len([call for call in calls if call == "xvfb-run"]), 5)
        directories = [call.split("--test-dir ")[1].split(" --output")[0]
                       for call in calls if call.startswith("ctest")]
        self.assertEqual([pathlib.Path(d).name for d in directories], ["release", "clang", "debug", "asan-ubsan", "tsan"])
        for call in calls:
            if call.startswith("cmake"):
                self.assertIn("HALFSPACE_BUILD_TESTS=ON", call)
                self.assertIn("HALFSPACE_WERROR=ON", call)
        self.assertIn("conformance", calls)
        self.assertEqual(done.stdout.splitlines()[-1], "100% tests passed, 0 tests failed out of 60")
        built = [call.split("/build/")[1].split() for call in calls if call.startswith("ninja")]
        # The lists of targets and tests first, or what is chosen from them would be yesterday's.
        self.assertEqual(built, [["release"]] + [[preset, *wanted] for preset in ("clang", "debug", "asan-ubsan", "tsan")
                                                 for wanted in (["build.ninja"], ["lib/x.so", "some_test"])] +
                         [["release", "halfspace_libgl"]])

    def test_a_failure_anywhere_fails(self):
        for failing, line in (("tsan", "96% tests passed, 2 tests failed out of 60"),
                              ("crash", "66% tests passed, 5 tests failed out of 15")):
            done, _ = self.run_script("test", FAKE_FAILING=failing)
            self.assertEqual(done.returncode, 1)
            self.assertEqual(done.stdout.splitlines()[-1], line)

    def test_a_build_that_fails_does_not_hide_the_others(self):
        done, calls = self.run_script("test", FAKE_NINJA_FAILS="clang")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len([call for call in calls if call.startswith("ctest")]), 4)
        self.assertIn("does not build", done.stdout)
        self.assertEqual(done.stdout.splitlines()[-1], "98% tests passed, 1 tests failed out of 51")

    def test_conformance_alone(self):
        done, calls = self.run_script("test", "conformance")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.splitlines()[-1], "100% tests passed, 0 tests failed out of 10")
        self.assertFalse([call for call in calls if call.startswith("ctest")])

    def test_labels_and_ctest_arguments(self):
        done, calls = self.run_script("test", "unit", "api", "-R", "a b", DISPLAY=":9")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(calls[-1].endswith("-L ^(unit|api)$ -R a b"), calls)
        self.assertNotIn("xvfb-run", calls)

    def test_a_stated_root_is_followed_through_a_link(self):
        link = self.calls / "halfspace"
        link.symlink_to(self.script)
        self.program("echo found")
        self.script = link
        done, _ = self.run_script("version", FAKE_BUILT="1")
        self.assertEqual(done.stdout, "found\n")


class Tree(unittest.TestCase):
    """The real script and list beside it."""

    def test_package_list(self):
        lines = (SCRIPT.parent / "cmake" / "debian-packages.txt").read_text().splitlines()
        pairs = [line.split() for line in lines if line and not line.startswith("#")]
        groups = ("build", "test", "conformance", "cross", "gallery")
        self.assertTrue(all(len(pair) == 2 and pair[0] in groups for pair in pairs), pairs)
        self.assertEqual(len({pair[1] for pair in pairs}), len(pairs))

    def test_ci_calls_the_script(self):
        text = (SCRIPT.parent / ".ci" / "run").read_text()
        self.assertIn("./halfspace test", text)
        for script in (SCRIPT, SCRIPT.parent / ".ci" / "run"):
            subprocess.run(["bash", "-n", script], check=True)


if __name__ == "__main__":
    SCRIPT = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
