// Where our shared libraries are, as seen from the running command.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "compare/process.h"

namespace halfspace::compare {

// A file this command needs is not where it looks; what() names the places and what to do.
struct NotFound : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The folder of the running executable, links resolved.
std::filesystem::path own_folder();

// The folder with `library` (libGL.so.1, libOSMesa.so.8): `stated` when given, or HALFSPACE_LIBRARY_DIR, or
// beside the command: ../lib once installed, ../gl in a build tree. Throws NotFound.
std::filesystem::path library_folder(const std::string& library,
                                     const std::optional<std::string>& stated = {});

// The folder with the oracle's `library`: `stated` when given, or beside the command in a build tree,
// ../oracle. It is part of the tests and never installed. Throws NotFound.
std::filesystem::path oracle_folder(const std::string& library,
                                    const std::optional<std::string>& stated = {});

// A program of the house: in the build tree ref_app/NAME, bench/NAME or among the hard cases, once installed
// ../libexec/halfspace/NAME. Throws NotFound.
std::filesystem::path house_program(const std::string& name);

// LD_LIBRARY_PATH with `folder` before what it holds already.
EnvironmentVariable library_path_with(const std::filesystem::path& folder);
// LD_PRELOAD with `library` before what it holds already.
EnvironmentVariable preload_with(const std::filesystem::path& library);

}  // namespace halfspace::compare
