// The ways to draw that `halfspace cost` sets beside each other.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/process.h"

namespace halfspace::compare {

enum class Library { ours, oracle, mesa };

struct Setting {
  std::string name;  // "standard", "filter draft", "llvmpipe"
  Library library = Library::ours;
  std::vector<EnvironmentVariable> environment;
  std::string axis;   // of the dial, where one alone is turned
  std::string level;  // of that axis, or of all; empty for other renderers
};

Setting truth_setting();
// Where the others are compared with.
Setting standard_setting();
// draft, standard, exact; then standard with each axis alone at draft and at exact.
std::vector<Setting> our_settings();
// OSMesa's llvmpipe, the same with float filters, softpipe.
std::vector<Setting> mesa_settings();

struct LibraryFolders {
  std::optional<std::string> ours, oracle;
};

// What a program needs in its environment to draw by `setting`, on one thread. `library` is the file it
// loads, libOSMesa.so.8 or libGL.so.1. Throws NotFound.
std::vector<EnvironmentVariable> environment_of(const Setting& setting, const LibraryFolders& folders,
                                                const std::string& library);

// Whether a renderer that calls itself so (GL_RENDERER) is the one asked for.
bool is_renderer_of(const Setting& setting, const std::string& gl_renderer);

}  // namespace halfspace::compare
