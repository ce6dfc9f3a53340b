#include "ref_app/program_path.h"

#include <filesystem>

namespace ref_app {

std::string program_directory() {
  std::error_code failure;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failure);
  return failure ? std::string(".") : program.parent_path().string();
}

}  // namespace ref_app
