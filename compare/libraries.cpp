#include "compare/libraries.h"

#include <cstdlib>
#include <system_error>
#include <vector>

namespace halfspace::compare {
namespace {

namespace fs = std::filesystem;

std::string environment_value(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

fs::path first_with(const std::string& file, const std::vector<fs::path>& folders,
                    const std::string& advice) {
  std::string looked;
  for (const fs::path& folder : folders) {
    std::error_code error;
    if (fs::exists(folder / file, error)) return fs::weakly_canonical(folder, error);
    looked += (looked.empty() ? "" : ", ") + folder.lexically_normal().string();
  }
  throw NotFound("no " + file + " in " + looked + "; " + advice);
}

EnvironmentVariable prepended(const char* name, const std::string& first, char separator) {
  const std::string rest = environment_value(name);
  return {name, rest.empty() ? first : first + separator + rest};
}

}  // namespace

fs::path own_folder() {
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::current_path() : executable.parent_path();
}

fs::path library_folder(const std::string& library, const std::optional<std::string>& stated) {
  if (stated) return first_with(library, {*stated}, "--library has to name the folder that holds it");
  const std::string from_environment = environment_value("HALFSPACE_LIBRARY_DIR");
  if (!from_environment.empty())
    return first_with(library, {from_environment},
                      "HALFSPACE_LIBRARY_DIR has to name the folder that holds it");
  return first_with(library, {own_folder() / ".." / "lib"},
                    "build it with `cmake --build --preset release`, or name its folder by --library or "
                    "HALFSPACE_LIBRARY_DIR");
}

fs::path oracle_folder(const std::string& library, const std::optional<std::string>& stated) {
  if (stated) return first_with(library, {*stated}, "--oracle has to name the folder that holds it");
  return first_with(
      library, {own_folder() / ".." / "oracle"},
      "the truth is drawn by a library of the tests: configure with -DHALFSPACE_BUILD_TESTS=ON and "
      "build, or name its folder by --oracle");
}

fs::path house_program(const std::string& name) {
  const fs::path base = own_folder() / "..";
  return first_with(name,
                    {base / "ref_app", base / "bench", base / "tests" / "numerics" / "hard",
                     base / "libexec" / "halfspace", own_folder()},
                    "build it with `cmake --build --preset release`") /
         name;
}

EnvironmentVariable library_path_with(const fs::path& folder) {
  return prepended("LD_LIBRARY_PATH", folder.string(), ':');
}

EnvironmentVariable preload_with(const fs::path& library) {
  return prepended("LD_PRELOAD", library.string(), ':');
}

}  // namespace halfspace::compare
