#include "ref_app/picture_spool.h"

#include <stdexcept>

namespace ref_app {
namespace {

constexpr int kRowsAtOnce = 32;

bool all_opaque(const uint8_t* rgba, size_t bytes) {
  for (size_t i = 3; i < bytes; i += 4) {
    if (rgba[i] != 255) return false;
  }
  return true;
}

}  // namespace

PictureSpool::PictureSpool() : file_(std::tmpfile()) {
  if (!file_) throw std::runtime_error("cannot make a temporary file for the pictures");
}

PictureSpool::~PictureSpool() { std::fclose(file_); }

bool PictureSpool::store(Renderer& renderer) {
  std::fseek(file_, 0, SEEK_END);
  entries_.push_back({std::ftell(file_), renderer.width(), renderer.height()});
  const size_t row_bytes = static_cast<size_t>(renderer.width()) * 4;
  std::vector<uint8_t> rows(row_bytes * kRowsAtOnce);
  bool opaque = true;
  for (int y = 0; y < renderer.height(); y += kRowsAtOnce) {
    const int count = renderer.height() - y < kRowsAtOnce ? renderer.height() - y : kRowsAtOnce;
    const size_t bytes = row_bytes * static_cast<size_t>(count);
    renderer.read_rows(y, count, rows.data());
    opaque = opaque && all_opaque(rows.data(), bytes);
    if (std::fwrite(rows.data(), 1, bytes, file_) != bytes) {
      throw std::runtime_error("cannot write to the temporary file; is the disk full?");
    }
  }
  return opaque;
}

Image PictureSpool::fetch(size_t index) {
  const Entry& entry = entries_.at(index);
  Image image{entry.width, entry.height, {}};
  image.rgba.resize(static_cast<size_t>(entry.width) * static_cast<size_t>(entry.height) * 4);
  std::fseek(file_, entry.offset, SEEK_SET);
  if (std::fread(image.rgba.data(), 1, image.rgba.size(), file_) != image.rgba.size()) {
    throw std::runtime_error("cannot read the temporary file back");
  }
  return image;
}

}  // namespace ref_app
