#include "tests/differential/true_frame.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace halfspace::differential {
namespace {

constexpr size_t kTruthBytes = 32, kBoundsBytes = 9;

struct Table {
  int width = 0, height = 0;
  std::string records;
};

Table read_table(const std::string& path, const std::string& kind, size_t record_bytes) {
  std::ifstream file(path, std::ios::binary);
  std::string line, word;
  std::getline(file, line);
  Table table;
  int version = 0;
  std::istringstream(line) >> word >> version >> table.width >> table.height;
  table.records.assign(std::istreambuf_iterator<char>(file), {});
  const size_t pixels = static_cast<size_t>(table.width) * static_cast<size_t>(table.height);
  if (word != kind || version != 1 || pixels == 0 || table.records.size() != pixels * record_bytes)
    throw std::runtime_error(path + " is not what the oracle writes");
  return table;
}

template <class T>
T read(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

}  // namespace

TrueFrame read_frame(const std::string& stem) {
  const Table truth = read_table(stem + ".truth", "halfspace-truth", kTruthBytes);
  const Table bounds = read_table(stem + ".bounds", "halfspace-bounds", kBoundsBytes);
  TrueFrame frame{truth.width, truth.height, {}};
  frame.pixels.resize(truth.records.size() / kTruthBytes);
  for (size_t i = 0; i < frame.pixels.size(); ++i) {
    TruePixel& pixel = frame.pixels[i];
    const char *t = &truth.records[i * kTruthBytes], *b = &bounds.records[i * kBoundsBytes];
    pixel.level = read<std::array<float, 4>>(t);
    pixel.owner = read<uint32_t>(t + 16), pixel.draw = read<uint32_t>(t + 20);
    pixel.depth = read<double>(t + 24);
    pixel.low = read<std::array<uint8_t, 4>>(b), pixel.high = read<std::array<uint8_t, 4>>(b + 4);
    pixel.doubtful = b[8] != 0;
  }
  return frame;
}

std::vector<std::string> frames_in(const std::string& directory) {
  std::vector<std::string> stems;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    if (entry.path().extension() == ".truth")
      stems.push_back((entry.path().parent_path() / entry.path().stem()).string());
  std::sort(stems.begin(), stems.end());
  return stems;
}

TrueFrame read_last_frame(const std::string& directory) {
  const std::vector<std::string> stems = frames_in(directory);
  if (stems.empty()) throw std::runtime_error("the oracle showed no frame");
  return read_frame(stems.back());
}

void remove_frames(const std::string& directory) {
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const auto extension = entry.path().extension();
    if (extension == ".truth" || extension == ".bounds") std::filesystem::remove(entry.path());
  }
}

}  // namespace halfspace::differential
