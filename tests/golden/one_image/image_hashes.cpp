// The random scenes' hashes on every instruction set this processor has and with 1, 2, 3 and 8 threads,
// against the published ones: image_hashes FILE.
#include <cstdio>
#include <fstream>

#include "tests/support/scenes.h"

int main(int argc, char** argv) {
  using namespace halfspace::test;
  std::ifstream file(argc == 2 ? argv[1] : "");
  std::map<std::string, std::string> published;
  for (std::string name, value; file >> name >> value;) published[name] = value;
  if (published.empty()) {
    std::fprintf(stderr, "usage: image_hashes FILE\n");
    return 2;
  }
  int wrong = 0;
  for (const std::string& isa : isa_levels()) {
    const IsaScope scope(isa);
    for (int threads : {1, 2, 3, 8}) {
      const auto hashes = scene_hashes(threads);
      int same = 0;
      for (const auto& [name, value] : published) {
        const auto found = hashes.find(name);
        if (found != hashes.end() && found->second == value)
          ++same;
        else
          std::printf("%s, %d threads: %s differs\n", isa.c_str(), threads, name.c_str());
      }
      std::printf("%s, %d threads: %d of %zu images are the published ones\n", isa.c_str(), threads, same,
                  published.size());
      wrong += same != int(published.size()) || hashes.size() != published.size();
    }
  }
  return wrong ? 1 : 0;
}
