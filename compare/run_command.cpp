// halfspace run PROGRAM: starts a program on our libGL by library path or preload; the binary is not touched.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "compare/capture.h"
#include "compare/commands.h"
#include "compare/image.h"
#include "compare/libraries.h"
#include "compare/process.h"

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLibraryName = "libGL.so.1";

struct RunOptions {
  std::vector<std::string> program;
  std::string capture, format = "png";
  std::optional<std::string> library;
  std::string stats, view;
  bool preload = false, force = false;
};

void require_program(const RunOptions& options) {
  if (options.program.empty())
    throw NotFound("which program? halfspace run [OPTIONS] PROGRAM [ARGUMENTS...]");
  if (options.program.front().starts_with("-"))
    throw NotFound(options.program.front() + " is no option of ours; see halfspace run --help");
}

ChildCommand child_command(const RunOptions& options) {
  const fs::path folder = library_folder(kLibraryName, options.library);
  ChildCommand child;
  child.arguments = options.program;
  child.environment.push_back(library_path_with(folder));
  if (options.preload) child.environment.push_back(preload_with(folder / kLibraryName));
  if (!options.capture.empty())
    child.environment.emplace_back("HALFSPACE_CAPTURE", fs::absolute(options.capture).string());
  if (!options.stats.empty())
    child.environment.emplace_back("HALFSPACE_STATS", options.stats == "draws" ? "draws" : "1");
  if (!options.view.empty()) child.environment.emplace_back("HALFSPACE_VIEW", options.view);
  return child;
}

// Frames of an earlier run must not be taken for this one's.
void make_capture_folder(const RunOptions& options) {
  fs::create_directories(options.capture);
  std::vector<fs::path> old = captured_frames(options.capture, "ppm");
  for (const fs::path& frame : captured_frames(options.capture, options.format)) old.push_back(frame);
  if (old.empty()) return;
  if (!options.force)
    throw NotFound(options.capture + " holds frames already (" + old.front().filename().string() +
                   ", ...); name another folder, or give --force to replace them");
  for (const fs::path& frame : old) fs::remove(frame);
}

int run_and_capture(const RunOptions& options) {
  make_capture_folder(options);
  const ChildResult result = run_child(child_command(options));
  const size_t frames = convert_frames(options.capture, options.format);
  if (frames > 0)
    std::fprintf(stderr, "halfspace run: %zu frame%s in %s\n", frames, frames == 1 ? "" : "s",
                 options.capture.c_str());
  else
    std::fprintf(
        stderr,
        "halfspace run: no frame was captured. The program ended before its first swap, or has a libGL of "
        "its own: try --preload, or see with `ldd %s` what it is linked with.\n",
        options.program.front().c_str());
  return result.exit_code;
}

int run(const RunOptions& options) {
  try {
    require_program(options);
    if (!options.capture.empty()) return run_and_capture(options);
    become(child_command(options));
  } catch (const StartError& error) {
    std::fprintf(stderr, "halfspace run: %s\n", error.what());
    return shell_status(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "halfspace run: %s\n", error.what());
    return kCouldNotTell;
  }
}

}  // namespace

void add_run_command(CLI::App& app, const std::vector<std::string>& program, int& status) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      app.add_subcommand("run", "Run a program on our libGL: halfspace run [OPTIONS] PROGRAM [ARGUMENTS...]");
  command->footer(
      "Environment handed on: HALFSPACE_THREADS, HALFSPACE_ISA, HALFSPACE_ACCURACY.\n"
      "Exit status: the program's; 127 not found, 126 cannot be executed, 2 our own trouble.");
  command->add_option("--capture", options->capture, "Write each swapped or finished frame into this folder")
      ->type_name("DIR");
  command->add_option("--format", options->format, "Format of captured frames: png, bmp, ppm, ...")
      ->capture_default_str();
  command->add_flag("--force", options->force, "Replace frames captured before");
  command->add_flag("--preload", options->preload,
                    "Also LD_PRELOAD libGL.so.1, for a program with a library path of its own");
  command->add_flag("--stats{picture}", options->stats,
                    "Print what each picture took; --stats=draws: each draw, too");
  command->add_option("--view", options->view, "Show the work instead of the picture")
      ->check(CLI::IsMember({"overdraw", "levels", "tiles", "wireframe"}));
  command->add_option("--library", options->library, "Folder that holds libGL.so.1")->type_name("DIR");
  // Everything from PROGRAM on is the program's, options too.
  command->prefix_command();
  command->callback([options, command, &program, &status] {
    options->program = command->remaining();
    options->program.insert(options->program.end(), program.begin(), program.end());
    status = run(*options);
  });
}

}  // namespace halfspace::compare
